#pragma once

#include <algorithm>

#include "kernels/core/angles.h"
#include "render/eyes/eye_camera.h"

namespace ergodome::test {

//! Returns a camera that faces the hole, with the spin axis up; its right is +e_φ.
inline EyeCamera eye_at(double spin, double r, double theta = 0.5 * pi, ObserverMotion motion = ObserverMotion::zamo) {
  EyeCamera eye{Spacetime{spin}, r, theta, 0.0, motion, {}, {}, r, theta};
  const double at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

}  // namespace ergodome::test
