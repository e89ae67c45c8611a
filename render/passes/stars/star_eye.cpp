#include "render/passes/stars/star_eye.h"

#include "render/lens/stations/lens_position.h"

namespace ergodome {

namespace {

//! Returns whether two cameras have the same spacetime, r and θ (up to rounding) and kind of
//! motion. Does not compare azimuths, orientations and velocities.
bool stand_alike(const EyeCamera& a, const EyeCamera& b) {
  return a.spacetime == b.spacetime && same_position({a.r, a.theta}, {b.r, b.theta}) && a.motion == b.motion;
}

double square_apart(const Vector3<double>& a, const Vector3<double>& b) { return dot(a - b, a - b); }

}  // namespace

bool served_alike(const StarEye& first, const StarEye& second) {
  if (first.omni || second.omni) {
    return first.omni && second.omni && see_alike(*first.omni, *second.omni);
  }
  constexpr double least_square = 1e-12;
  return stand_alike(first.camera, second.camera) &&
         square_apart(first.camera.velocity, second.camera.velocity) < least_square;
}

bool sees_alike(const StarEye& first, const StarEye& second) {
  return served_alike(first, second) && first.camera.phi == second.camera.phi &&
         square_apart(first.camera.velocity, second.camera.velocity) == 0.0;
}

}  // namespace ergodome
