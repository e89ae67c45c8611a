#pragma once

#include <vector>

#include "kernels/published/quadtree_look_up.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Builds the quadtree grid published by VE.

namespace ergodome {

//! The published parameters of VE's grid.
struct QuadtreeSettings {
  int coarsest_level = 6;
  int finest_level = 10;
  //! Limit for a cell's diagonals on the celestial sphere. VE write "0.015 radians", but only the
  //! squared length in (θ, φ), seam included, gives their count of 47,848 rays (a = 0.999, r = 5,
  //! geodesic observer, half the sky) and their cumulative errors.
  double largest_diagonal_squared = 0.015;
  TraceMethod method = TraceMethod::taylor;
  double tolerance = 1e-9;
  bool repair = true;  //!< repair T-vertices
};

//! Returns whether the upper half of a camera's grid suffices: the camera is on the equator and
//! moves along it.
bool quadtree_is_mirrored(double theta, const Vector3<double>& velocity);

//! A quadtree grid and its vertices.
class QuadtreeLens {
 public:
  //! Traces the grid of a camera at φ = 0, in its observer's frame. `mirrored`: traces only the
  //! upper half, see quadtree_is_mirrored().
  QuadtreeLens(const CameraStation& camera, bool mirrored, const QuadtreeSettings& settings);

  //! Returns the grid as kernels on the host read it; it points into this object.
  [[nodiscard]] QuadtreeGrid view() const;

  //! Returns the number of vertices, each of which took one ray.
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

//! The position of the shadow in a camera's grid, from the exact critical curve.
class QuadtreeShadowTable {
 public:
  QuadtreeShadowTable(const CameraStation& camera, int level);

  //! Returns the table as kernels read it; it points into this object.
  [[nodiscard]] QuadtreeShadow view() const;

 private:
  float row_ = 0.0F;
  float column_ = 0.0F;
  std::vector<float> radius_;
};

//! Returns a single grid in the form that look-ups need.
QuadtreeLookUp look_up_of(const QuadtreeGrid& grid, QuadtreeInterpolation how);

}  // namespace ergodome
