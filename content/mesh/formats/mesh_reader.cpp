#include "content/mesh/formats/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "content/files/printable.h"
#include "content/files/whole_file.h"
#include "content/mesh/formats/gltf_reader.h"
#include "content/mesh/formats/obj_reader.h"
#include "content/mesh/mesh_builder.h"
#include "content/mesh/named_file.h"
#include "content/mesh/triangle_mesh.h"
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

namespace fs = std::filesystem;

void add_file(const fs::path& folder, std::string_view name, std::vector<fs::path>& files) {
  constexpr std::size_t max_files = 1000;
  const fs::path path = file_of_mesh(folder, std::string(name));
  if (!path.empty() && files.size() < max_files && std::ranges::find(files, path) == files.end()) {
    files.push_back(path);
  }
}

//! Returns the existing files in `folder`, or below it, that are named under "uri" in the JSON of a
//! .gltf, or in the JSON chunk of a .glb.
std::vector<fs::path> files_of_gltf(std::string_view text, const fs::path& folder) {
  constexpr std::string_view key = "\"uri\"";
  std::vector<fs::path> files;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    const std::size_t begin = text.find('"', at + key.size());
    const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
    // Longer values are embedded data, not names.
    if (end != std::string::npos && end - begin < 4096) {
      const auto name = nlohmann::json::parse(text.substr(begin, end - begin + 1), nullptr, false);
      add_file(folder, name.is_string() ? name.get<std::string>() : "", files);
    }
  }
  return files;
}

}  // namespace

TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& location,
                        const std::filesystem::path& folder) {
  if (bytes.size() > largest_mesh_bytes) {
    throw Error(location, "is larger than 1 GiB", "simplify the mesh");
  }
  TriangleMesh mesh;
  try {
    mesh = format == MeshFormat::obj ? read_obj(bytes, location, folder)
                                     : read_gltf(bytes, format == MeshFormat::glb, location, folder);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(location, fmt::format("cannot be read: {}", problem.what()), wanted_meshes);
  }
  drop_degenerate_triangles(mesh);
  repair_normals(mesh);
  if (mesh.indices.empty()) {
    throw Error(location,
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

std::vector<fs::path> files_of_mesh(const fs::path& mesh) {
  const fs::path folder = mesh.has_parent_path() ? mesh.parent_path() : fs::path(".");
  std::string ending = mesh.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool obj = ending == ".obj";
  if (!obj && ending != ".gltf" && ending != ".glb") {
    return {};
  }
  try {
    const std::string text = read_whole_file(mesh, largest_mesh_bytes, wanted_meshes);
    return obj ? files_of_obj(text, folder) : files_of_gltf(text, folder);
  } catch (const Error&) {
    return {};  // The file cannot be read; the mesh reader reports why.
  }
}

}  // namespace ergodome
