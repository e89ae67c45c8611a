#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernels/objects/surface.h"

namespace ergodome {

//! The picture on some triangles.
struct MeshImage {
  std::string name;                          //!< path of its file, or what messages call it; empty: there is none
  std::shared_ptr<const std::string> bytes;  //!< of one that is inside the mesh's own file, coded as its name ends
  std::string mesh;                          //!< path of the mesh that names a file of its own
  bool of_gltf = false;                      //!< its colours are sRGB, whatever its file says of them (glTF 2.0, 3.8.3)

  [[nodiscard]] bool empty() const { return name.empty(); }
};

//! Triangles of one look, one after the other in the indices.
struct MeshPart {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::array<float, 3> color = {1.0F, 1.0F, 1.0F};  //!< linear light; multiplies the image
  MeshImage image;
  TextureWrap wrap_u = TextureWrap::repeat;
  TextureWrap wrap_v = TextureWrap::repeat;
  bool transparent = false;        //!< its file says so; it is drawn opaque
  bool image_alpha_counts = true;  //!< alpha of the image is meant as transparency
};

//! A surface of triangles, in a unit and about a middle of its own. Their corners run counterclockwise as seen from outside.
struct TriangleMesh {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;  //!< three a triangle
  std::vector<MeshPart> parts;         //!< all indices, in their order
  long dropped_triangles = 0;          //!< left out, because they have no area
  std::vector<std::string> remarks;    //!< sentences about what of its file is not drawn as its maker may think

  [[nodiscard]] long triangle_count() const { return static_cast<long>(indices.size() / 3); }
  [[nodiscard]] long bytes() const {
    return static_cast<long>(vertices.size() * sizeof(SurfaceVertex) + indices.size() * sizeof(std::uint32_t));
  }
};

//! Leaves out triangles without area (such as those with a corner that is no number), and counts them; parts that are left empty go, too.
void drop_degenerate_triangles(TriangleMesh& mesh);

//! The distance of the corner that is farthest from the mesh's own middle.
double radius_of(const TriangleMesh& mesh);

}  // namespace ergodome
