#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// Parallax in the observer's flat tangent space, the model of Hamilton & Polhemus (New Journal of
// Physics 12 (2010) 123027). An object seen in direction n at the affine distance d is at d n, and
// an eye at e sees it as in flat space.
namespace ergodome::inline ERGO_TARGET {

//! Returns the direction in which an eye at `eye` [M] sees an object that the head sees in
//! direction `n` (unit vector) at affine distance `distance` [M]. An infinite distance leaves the
//! direction unchanged. The object must not be at the eye's position.
ERGO_HD Vector3<double> seen_by_eye(const Vector3<double>& n, double distance, const Vector3<double>& eye) {
  const Vector3<double> way = n - (1.0 / distance) * eye;
  return (1.0 / ::sqrt(dot(way, way))) * way;
}

//! Returns the direction in which the head sees an object that the eye sees in direction `m`: the
//! inverse. `distance` is the object's distance from the head [M] and must exceed the eye's.
ERGO_HD Vector3<double> seen_by_head(const Vector3<double>& m, double distance, const Vector3<double>& eye) {
  // | e + s m | = d
  const Vector3<double> e = (1.0 / distance) * eye;
  const double along = dot(e, m);
  const double way = ::sqrt(along * along + 1.0 - dot(e, e)) - along;
  return e + way * m;
}

}  // namespace ergodome::inline ERGO_TARGET
