#pragma once

#include <vector>

#include "kernels/published/quadtree_look_up.h"
#include "kernels/spacetime/trace/trace_rays.h"

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

//! Whether the upper half of a camera's grid is enough: it sits on the equator and moves along it.
bool quadtree_is_mirrored(double theta, const Vector3<double>& velocity);

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

//! Where the shadow lies in the grid of a camera, from the exact critical curve.
class QuadtreeShadowTable {
 public:
  QuadtreeShadowTable(const CameraStation& camera, int level);

  //! It points into this object.
  [[nodiscard]] QuadtreeShadow view() const;

 private:
  float row_ = 0.0F;
  float column_ = 0.0F;
  std::vector<float> radius_;
};

//! A grid by itself, as look-ups want it.
QuadtreeLookUp look_up_of(const QuadtreeGrid& grid, QuadtreeInterpolation how);

}  // namespace ergodome
