#pragma once

#include <vector>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! A mesh in the current OpenGL context, with the images of its parts.
class GlMesh {
 public:
  //! Throws Error if an image cannot be read or the driver cannot allocate memory.
  explicit GlMesh(const TriangleMesh& mesh);
  ~GlMesh();
  GlMesh(const GlMesh&) = delete;
  GlMesh& operator=(const GlMesh&) = delete;

  //! A part of the mesh: range of its indices, its color and its texture (0: none).
  struct Part {
    std::uint32_t first_index;
    std::uint32_t index_count;
    std::array<float, 3> color;
    unsigned image;
  };

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }

  //! Binds the buffers for the following draw calls.
  void bind() const;
  //! Draws a part as patches of three vertices. `max_level`: maximum number of pieces into which
  //! the shaders divide an edge; limits the patches per draw call if OpenGL renders on the CPU.
  void draw(const Part& part, double max_level) const;

 private:
  unsigned vertex_array_ = 0;
  unsigned vertices_ = 0;
  unsigned indices_ = 0;
  bool in_software_;  //!< true if OpenGL renders on the CPU
  std::vector<Part> parts_;
};

}  // namespace ergodome
