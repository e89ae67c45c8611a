#include "content/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>

#include "content/files/printable.h"
#include "content/mesh/named_file.h"

namespace ergodome {

void MeshBuilder::reserve(std::size_t triangles, std::size_t vertices) {
  triangles_ += triangles;
  if (triangles_ > max_mesh_triangles || mesh_.vertices.size() + vertices > max_mesh_vertices) {
    throw error(fmt::format("has more than {} triangles or {} vertices", max_mesh_triangles, max_mesh_vertices),
                "simplify the mesh");
  }
}

std::uint32_t MeshBuilder::add_vertex(const SurfaceVertex& vertex) {
  mesh_.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::add_triangle(int material, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::vector<std::uint32_t>& indices = indices_[material];
  indices.insert(indices.end(), {a, b, c});
}

void MeshBuilder::remark(const std::string& sentence) {
  constexpr std::size_t max_remarks = 20;
  if (mesh_.remarks.size() < max_remarks && std::ranges::find(mesh_.remarks, sentence) == mesh_.remarks.end()) {
    mesh_.remarks.push_back(sentence);
  }
}

MeshImage image_beside_mesh(const std::string& name, const std::string& location, const std::filesystem::path& folder) {
  constexpr std::size_t longest_name = 200;
  if (name.starts_with("data:")) {
    throw Error(location, "has an unreadable image inside the file", "export it with PNG or JPEG images");
  }
  if (leads_outside(name)) {
    throw Error(location,
                fmt::format("refers to an image outside its folder (\"{}\")", printable(name.substr(0, longest_name))),
                "put the images into the folder of the mesh");
  }
  const std::filesystem::path there = file_of_mesh(folder, name);
  if (there.empty() && !folder.empty()) {
    throw missing_file(location, name);
  }
  return {there.empty() ? name : there.string(), nullptr, location};
}

Error missing_file(const std::string& location, const std::string& name) {
  constexpr std::size_t longest_name = 200;
  return {location,
          fmt::format("refers to \"{}\", which is not in its folder", printable(name.substr(0, longest_name))),
          "put the file there, or remove the reference"};
}

}  // namespace ergodome
