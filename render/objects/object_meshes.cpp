#include "render/objects/object_meshes.h"

#include <filesystem>
#include <map>
#include <string>

#include "content/mesh/built_in_meshes.h"
#include "content/mesh/mesh_reader.h"

namespace ergodome {

namespace {

TriangleMesh make_mesh(const ObjectSettings& object, const std::string& folder) {
  switch (object.form) {
    case ObjectForm::triangle:
      return make_triangle(object.triangle);
    case ObjectForm::sphere:
      return make_sphere(object.sphere);
    case ObjectForm::disk:
      return make_disk(object.disk);
    case ObjectForm::mesh:
      break;
  }
  return read_mesh(std::filesystem::path(folder) / object.mesh);
}

}  // namespace

ObjectMeshes load_meshes(const Show& show) {
  ObjectMeshes loaded;
  std::map<std::string, std::size_t> files;
  for (const ObjectSettings& object : show.objects) {
    const auto known = files.find(object.mesh);
    if (object.form == ObjectForm::mesh && known != files.end()) {
      loaded.mesh_of.push_back(known->second);
      continue;
    }
    files[object.mesh] = loaded.meshes.size();
    loaded.mesh_of.push_back(loaded.meshes.size());
    loaded.meshes.push_back(make_mesh(object, show.folder));
  }
  return loaded;
}

OverlayImage read_mesh_image(const MeshImage& image) {
  return image.bytes ? read_overlay_image(*image.bytes, image.name) : read_overlay_image(image.name);
}

}  // namespace ergodome
