#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "kernels/core/error.h"

namespace ergodome {

//! Limits of mesh files. Larger files are refused before memory is allocated for them.
inline constexpr std::size_t largest_mesh_bytes = std::size_t{1} << 30U;
inline constexpr std::size_t max_mesh_triangles = 20'000'000;
inline constexpr std::size_t max_mesh_vertices = 3 * max_mesh_triangles;

//! Maximum light of a surface that only emits; display white is 1. More is clamped.
inline constexpr float brightest_glow = 60'000.0F;

//! The remedy in error messages about files that are not meshes.
inline constexpr const char* wanted_meshes = "use a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb)";

//! Builds a mesh from triangles whose materials come in any order: each material becomes one part.
class MeshBuilder {
 public:
  //! `location` is the name of the mesh in messages.
  explicit MeshBuilder(std::string location) : location_(std::move(location)) {}

  [[nodiscard]] const std::string& location() const { return location_; }

  //! Throws Error if this many more triangles and vertices exceed the limits. Call it before adding
  //! them.
  void reserve(std::size_t triangles, std::size_t vertices);

  std::uint32_t add_vertex(const SurfaceVertex& vertex);
  void add_triangle(int material, std::uint32_t a, std::uint32_t b, std::uint32_t c);

  //! Adds a remark on a feature of the file that is drawn differently or not at all, such as "is
  //! animated; it is drawn in its default pose". Ignores repeated remarks, and all after 20.
  void remark(const std::string& sentence);

  //! Moves the mesh out of the builder, with one part per material, in ascending order.
  //! `part_of(material)` must return the part of a material; its range of indices is set here.
  template <class PartOf>
  TriangleMesh take(const PartOf& part_of) {
    for (const auto& [material, indices] : indices_) {
      MeshPart part = part_of(material);
      part.first_index = static_cast<std::uint32_t>(mesh_.indices.size());
      part.index_count = static_cast<std::uint32_t>(indices.size());
      mesh_.indices.insert(mesh_.indices.end(), indices.begin(), indices.end());
      mesh_.parts.push_back(std::move(part));
    }
    return std::move(mesh_);
  }

  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const {
    return {location_, problem, remedy};
  }

 private:
  std::string location_;
  TriangleMesh mesh_;
  std::map<int, std::vector<std::uint32_t>> indices_;
  std::size_t triangles_ = 0;
};

//! Returns a reference to the image file that a mesh names, as file_of_mesh() finds it. Throws
//! Error for a data URI, a name that leads out of `folder`, or a missing file. With an empty
//! `folder`, the reference has the name as it is.
MeshImage image_beside_mesh(const std::string& name, const std::string& location, const std::filesystem::path& folder);

//! Returns the error for a mesh that names a file that is not in its folder.
Error missing_file(const std::string& location, const std::string& name);

}  // namespace ergodome
