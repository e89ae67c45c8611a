#include "content/mesh/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "content/files/counted.h"
#include "content/files/whole_file.h"
#include "content/mesh/gltf/gltf_reader.h"
#include "content/mesh/mesh_normals.h"
#include "content/mesh/obj/obj_reader.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

MeshFormat format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj") {
    return MeshFormat::obj;
  }
  if (ending == ".gltf" || ending == ".glb") {
    return ending == ".glb" ? MeshFormat::glb : MeshFormat::gltf;
  }
  throw Error(path.string(), "is not a supported mesh format", wanted_meshes);
}

}  // namespace

TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& place,
                        const std::filesystem::path& folder) {
  if (bytes.size() > largest_mesh_bytes) {
    throw Error(place, "is larger than 1 GiB", "simplify the mesh");
  }
  TriangleMesh mesh;
  try {
    mesh = format == MeshFormat::obj ? read_obj(bytes, place, folder)
                                     : read_gltf(bytes, format == MeshFormat::glb, place, folder);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(place, fmt::format("cannot be read: {}", problem.what()), wanted_meshes);
  }
  drop_degenerate_triangles(mesh);
  repair_normals(mesh);
  if (mesh.indices.empty()) {
    throw Error(place,
                mesh.dropped_triangles > 0
                    ? fmt::format("has only {} without area", counted(mesh.dropped_triangles, "triangle"))
                : mesh.remarks.empty() ? std::string("has no triangles")
                                       : fmt::format("has no triangles; it {}", mesh.remarks.front()),
                wanted_meshes);
  }
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  const std::string bytes = read_whole_file(path, largest_mesh_bytes, wanted_meshes);
  std::filesystem::path folder = path.parent_path();
  return parse_mesh(bytes, format, path.string(), folder.empty() ? std::filesystem::path(".") : folder);
}

}  // namespace ergodome
