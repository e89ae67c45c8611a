#pragma once

#include <vector>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! A mesh in the current OpenGL context, with the images of its parts.
class GlMesh {
 public:
  //! Throws Error where an image cannot be read, or the driver has no room.
  explicit GlMesh(const TriangleMesh& mesh);
  ~GlMesh();
  GlMesh(const GlMesh&) = delete;
  GlMesh& operator=(const GlMesh&) = delete;

  //! A part of it: where its indices are, its colour and its image (0: none).
  struct Part {
    std::uint32_t first_index;
    std::uint32_t index_count;
    std::array<float, 3> color;
    unsigned image;
  };

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }

  //! Binds what the next calls draw from.
  void bind() const;
  //! Draws a part as patches of three corners, whose edges are divided into `most_level` parts at the most.
  void draw(const Part& part, double most_level) const;

 private:
  unsigned vertex_array_ = 0;
  unsigned vertices_ = 0;
  unsigned indices_ = 0;
  bool in_software_;  //!< the processor draws
  std::vector<Part> parts_;
};

}  // namespace ergodome
