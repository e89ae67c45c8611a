#pragma once

#include <vector>

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/object_rays.h"

namespace ergodome {

//! Where the path of a ray that is followed back from an eye ends.
enum class CurveEnd { object, hole, sky };

//! Path of a ray that an eye sees, about a hole of any spin.
struct TracedCurve {
  std::vector<Vector3<double>> places;  //!< pseudo-Cartesian, from where the light comes to the eye [M]
  CurveEnd end = CurveEnd::sky;
  int object = -1;     //!< which one, for CurveEnd::object
  int order = 1;       //!< 1 and as many more as it has gone half turns round the hole
  double delay = 0.0;  //!< how long light takes from the object to the eye [M]
};

//! Which of a view's rays are followed.
struct TracedChoice {
  int count = 24;      //!< about how many; two thirds of them end on objects, where there are such
  int most_order = 5;  //!< those to objects that have gone farther round are left out
  double reach;        //!< paths that leave go as far as this from the hole [M]
};

//! The path of the ray that a camera sees in direction `n` (e_r, e_θ, e_φ), as far as its hit, the hole or `reach`.
TracedCurve traced_curve(const CameraStation& camera, const Vector3<double>& n, const MeshHit& hit, double reach);

//! Follows rays through pixels of a coarse picture of an eye's view, and takes some that are spread over it: first those that meet objects, of every order
//! as many, then others.
std::vector<TracedCurve> traced_curves(const EyeCamera& eye, const Projection& coarse, const ObjectRays& objects,
                                       const TracedChoice& choice);

}  // namespace ergodome
