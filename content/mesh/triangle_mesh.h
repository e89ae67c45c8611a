#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernels/objects/surface.h"

namespace ergodome {

//! The image on the triangles of a MeshPart.
struct MeshImage {
  std::string name;  //!< path of its file, or its name in messages; empty if there is no image
  //! Bytes of an embedded image, in the format that the ending of `name` states.
  std::shared_ptr<const std::string> bytes;
  std::string mesh;      //!< path of the mesh that names a separate image file
  bool of_gltf = false;  //!< colors are sRGB, whatever the image's metadata states (glTF 2.0, 3.8.3)

  [[nodiscard]] bool empty() const { return name.empty(); }
};

//! Triangles with the same material, consecutive in the indices.
struct MeshPart {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::array<float, 3> color = {1.0F, 1.0F, 1.0F};  //!< linear light; multiplies the image
  MeshImage image;
  TextureWrap wrap_u = TextureWrap::repeat;
  TextureWrap wrap_v = TextureWrap::repeat;
  bool transparent = false;        //!< the file states transparency; drawn opaque nevertheless
  bool image_alpha_counts = true;  //!< alpha of the image is meant as transparency
};

//! A surface of triangles, in its own unit and coordinates. Corners run counterclockwise as seen
//! from outside.
struct TriangleMesh {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;  //!< three per triangle
  std::vector<MeshPart> parts;         //!< cover all indices, in their order
  long dropped_triangles = 0;          //!< dropped because they have no area
  std::vector<std::string> remarks;    //!< sentences about features that are drawn differently or not at all

  [[nodiscard]] long triangle_count() const { return static_cast<long>(indices.size() / 3); }
  [[nodiscard]] long bytes() const {
    return static_cast<long>(vertices.size() * sizeof(SurfaceVertex) + indices.size() * sizeof(std::uint32_t));
  }
};

//! Drops triangles without area, also those with a non-finite corner, and counts them. Removes
//! parts that become empty.
void drop_degenerate_triangles(TriangleMesh& mesh);

//! Returns the maximum distance of a triangle's corner from the origin of the mesh.
double radius_of(const TriangleMesh& mesh);

//! Replaces normals that are nearly zero or non-finite by the mean normal of the faces that share
//! the vertex, weighted by area. If these cancel, the first face's normal is used; vertices without
//! faces keep theirs.
void repair_normals(TriangleMesh& mesh);

}  // namespace ergodome
