#pragma once

#include <vector>

#include "kernels/published/quadtree_look_up.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Builds the quadtree grid that Verbraeck & Eisemann (2021) published.

namespace ergodome {

//! The parameters of Verbraeck & Eisemann's (VE's) grid, with their published values, and the
//! integrator of its rays.
struct QuadtreeSettings {
  int coarsest_level = 6;
  int finest_level = 10;
  //! Limit for the diagonals of a cell on the celestial sphere: the squared length in (θ, φ). VE
  //! write "0.015 radians", but only the squared length, with cells across the seam of φ included,
  //! gives the number of rays that they report, 47,848 (a = 0.999, r = 5, geodesic observer, half
  //! the sky), and their cumulative errors.
  double largest_diagonal_squared = 0.015;
  TraceMethod method = TraceMethod::taylor;
  double tolerance = 1e-9;
  //! True: vertices inside the side of a larger cell (T-vertices) get values interpolated along it.
  bool repair = true;
};

//! Returns whether the upper half of a camera's grid suffices: the camera is on the equator and its
//! velocity (e_r, e_θ, e_φ) has no component across it.
bool quadtree_is_mirrored(double theta, const Vector3<double>& velocity);

//! A quadtree grid and its vertices.
class QuadtreeLens {
 public:
  //! Traces the grid of a camera at φ = 0, in its observer's frame. `mirrored`: traces only the
  //! upper half, see quadtree_is_mirrored().
  QuadtreeLens(const CameraStation& camera, bool mirrored, const QuadtreeSettings& settings);

  //! Returns the grid as kernels on the host read it; it points into this object.
  [[nodiscard]] QuadtreeGrid view() const;

  //! Returns the number of vertices; one ray was traced for each.
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

//! The shadow's center, and its edge around it, in rows and columns of a quadtree grid in a
//! camera's view. Computed from the exact critical curve.
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

//! Returns a single grid in the form that look-ups read.
QuadtreeLookUp look_up_of(const QuadtreeGrid& grid, QuadtreeInterpolation how);

}  // namespace ergodome
