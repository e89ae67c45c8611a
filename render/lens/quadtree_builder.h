#pragma once

#include <vector>

#include "kernels/lens/quadtree_grid.h"
#include "kernels/trace/trace_rays.h"

namespace ergodome {

//! The published parameters of VE's grid.
struct QuadtreeSettings {
  int coarsest_level = 6;
  int finest_level = 10;
  //! Of a cell's diagonals on the celestial sky. VE write "0.015 radians"; it is the squared length in (θ, φ), seam and all, that
  //! gives their own count of 47,848 rays (a = 0.999, r = 5, geodesic observer, half the sky) and their cumulative errors.
  double largest_diagonal_squared = 0.015;
  TraceMethod method = TraceMethod::taylor;
  double tolerance = 1e-9;
  bool repair = true;  //!< of T-vertices
};

//! A quadtree grid and its vertices.
class QuadtreeLens {
 public:
  //! Traces the grid of a camera (at φ = 0), in the frame of its observer. `mirrored`: the camera sits on the equator and moves along
  //! it, and the upper half is enough.
  QuadtreeLens(const CameraStation& camera, bool mirrored, const QuadtreeSettings& settings);

  //! The grid as kernels on the host read it; it points into this object.
  [[nodiscard]] QuadtreeGrid view() const;

  //! Rays traced: one a vertex.
  [[nodiscard]] int vertex_count() const { return vertex_count_; }

 private:
  friend class QuadtreeBuilder;

  void insert(int row, int column, const SkyAngles& sky);
  void grow();

  std::vector<QuadtreeVertex> slots_;
  int vertex_count_ = 0;
  int level_;
  bool mirrored_;
};

}  // namespace ergodome
