#pragma once

#include <vector>

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/object_rays.h"

// Traces the rays of an observer's view, for diagrams.

namespace ergodome {

//! Where the path of a ray traced back from an eye ends.
enum class CurveEnd { object, hole, sky };

//! The path of a ray that an eye sees, for any spin of the hole.
struct TracedCurve {
  //! Points of the path from the origin of the light to the eye, pseudo-Cartesian [M].
  std::vector<Vector3<double>> positions;
  CurveEnd end = CurveEnd::sky;
  int object = -1;     //!< index of the object in the show, for CurveEnd::object; otherwise -1
  int order = 1;       //!< 1 plus the number of whole half turns around the hole
  double delay = 0.0;  //!< light travel time from the object to the eye [M]
};

//! Selects which rays of a view are traced.
struct TracedChoice {
  //! Maximum number of rays; at most two thirds of them end on objects.
  int count = 24;
  int max_order = 5;  //!< rays to objects of higher order are left out
  double reach;       //!< paths to the sky end at this distance from the hole [M]
};

//! Computes the path of the ray that a camera sees in direction `n` (e_r, e_θ, e_φ), traced back
//! until it meets the object `hit`, falls into the hole or reaches the distance `reach` [M].
TracedCurve traced_curve(const CameraStation& camera, const Vector3<double>& n, const MeshHit& hit, double reach);

//! Traces rays back through the pixels of a coarse picture of an eye's view, and selects some that
//! are spread over the view: first rays that meet objects, equally many of every image order, then
//! others.
std::vector<TracedCurve> traced_curves(const EyeCamera& eye, const Projection& coarse, const ObjectRays& objects,
                                       const TracedChoice& choice);

}  // namespace ergodome
