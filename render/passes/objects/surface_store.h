#pragma once

#include <deque>
#include <vector>

#include "content/mesh/triangle_boxes.h"
#include "content/show/show.h"
#include "kernels/objects/surface.h"
#include "render/backend/buffer.h"
#include "render/passes/objects/object_horizon.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! The meshes of a show's objects with their trees and images, in the memory of a backend.
class SurfaceStore {
 public:
  //! Reads or generates the meshes, each file once. Throws Error if one cannot be read.
  SurfaceStore(const Show& show, Backend backend);

  //! Returns the objects that are partly invisible because they extend into the horizon.
  [[nodiscard]] const std::vector<ObjectInHorizon>& in_horizon() const { return in_horizon_; }

  //! trees() returns the triangle trees, surfaces() the surfaces, both with one entry per object.
  [[nodiscard]] const std::vector<TriangleTree>& trees() const { return trees_; }
  [[nodiscard]] const std::vector<Surface>& surfaces() const { return surfaces_; }

  //! Returns the triangle trees in host memory. If the backend is not the CPU, trees of meshes with
  //! more than a million triangles have no nodes here.
  [[nodiscard]] const std::vector<TriangleTree>& host_trees() const { return host_trees_; }

  [[nodiscard]] const std::vector<MeshOutline>& outlines() const { return outlines_; }

  [[nodiscard]] long triangle_count() const { return triangle_count_; }

 private:
  //! The arrays of one mesh.
  struct Stored {
    Buffer<TreeNode> nodes;
    Buffer<float> corners;
    Buffer<std::uint32_t> triangles;
    Buffer<SurfaceVertex> vertices;
    Buffer<std::uint32_t> indices;
    Buffer<std::uint32_t> part_of;
    Buffer<SurfacePart> parts;
    std::deque<Buffer<std::uint16_t>> images;
    Vector3<double> middle{};
    double radius = 0.0;
    MeshOutline outline;
    TriangleBoxes kept;  //!< host copy, if the backend is not the CPU
    TriangleTree host_tree{};
  };

  static Stored store(const TriangleMesh& mesh, Backend backend);

  std::deque<Stored> meshes_;
  std::vector<TriangleTree> trees_;
  std::vector<TriangleTree> host_trees_;
  std::vector<Surface> surfaces_;
  std::vector<MeshOutline> outlines_;
  std::vector<ObjectInHorizon> in_horizon_;
  long triangle_count_ = 0;
};

}  // namespace ergodome
