#include "render/passes/objects/object_meshes.h"

#include <fmt/format.h>

#include <map>
#include <string>

#include "content/mesh/built_in_meshes.h"
#include "content/mesh/formats/mesh_reader.h"
#include "content/show/show_errors.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

TriangleMesh make_mesh(const Show& show, std::size_t number) {
  const ObjectSettings& object = show.objects[number];
  switch (object.form) {
    case ObjectForm::triangle:
      try {
        return make_triangle(object.triangle);
      } catch (const Error& error) {
        throw named_by(show, fmt::format("objects[{}]", number), error);
      }
    case ObjectForm::sphere:
      return make_sphere(object.sphere);
    case ObjectForm::disk:
      return make_disk(object.disk);
    case ObjectForm::mesh:
      break;
  }
  return read_named(show, fmt::format("objects[{}].mesh", number), object.mesh, read_mesh);
}

}  // namespace

ObjectMeshes load_meshes(const Show& show) {
  ObjectMeshes loaded;
  std::map<std::string, std::size_t> files;
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    const ObjectSettings& object = show.objects[i];
    const auto known = files.find(object.mesh);
    if (object.form == ObjectForm::mesh && known != files.end()) {
      loaded.mesh_of.push_back(known->second);
      continue;
    }
    files[object.mesh] = loaded.meshes.size();
    loaded.mesh_of.push_back(loaded.meshes.size());
    loaded.meshes.push_back(make_mesh(show, i));
  }
  return loaded;
}

OverlayImage read_mesh_image(const MeshImage& image) {
  if (image.bytes) {
    return read_stored_image(*image.bytes, image.name);
  }
  try {
    return read_stored_image(image.name);
  } catch (const Error& error) {
    throw Error(error.location(), fmt::format("{} (texture of {})", error.problem(), image.mesh), error.remedy());
  }
}

}  // namespace ergodome
