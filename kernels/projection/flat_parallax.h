#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// Parallax in the observer's flat tangent space, the model of Hamilton & Polhemus (New Journal of Physics 12 (2010) 123027): a thing that is
// seen in direction n at the affine distance d stands at d n, and an eye at e sees it as anyone would in flat space.
namespace ergodome::inline ERGO_TARGET {

//! The direction in which an eye at `eye` [M] sees a thing that the head sees in direction `n` (unit vector) at affine distance `distance`
//! [M]; infinity leaves the direction. The thing is not at the eye's place.
ERGO_HD Vector3<double> seen_by_eye(const Vector3<double>& n, double distance, const Vector3<double>& eye) {
  const Vector3<double> way = n - (1.0 / distance) * eye;
  return (1.0 / ::sqrt(dot(way, way))) * way;
}

//! The inverse: the direction in which the head sees what an eye sees in direction `m` and what is `distance` M from the head. The eye is
//! nearer to the head than that.
ERGO_HD Vector3<double> seen_by_head(const Vector3<double>& m, double distance, const Vector3<double>& eye) {
  // | e + s m | = d
  const Vector3<double> e = (1.0 / distance) * eye;
  const double along = dot(e, m);
  const double way = ::sqrt(along * along + 1.0 - dot(e, e)) - along;
  return e + way * m;
}

}  // namespace ergodome::inline ERGO_TARGET
