#pragma once

#include "kernels/objects/lamp_source.h"
#include "kernels/objects/local_frame.h"
#include "kernels/objects/ray_arrival.h"
#include "kernels/spacetime/shadow/shadow_chart.h"

// Finds the direct ray from a point to another point that is at least as far from the hole.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Start and target of a ray. `near_enough`: miss [rad about the hole] below which the next step is
//! the last.
struct RayEnds {
  Vector3<double> from;  //!< start of the ray, pseudo-Cartesian [M]
  //! Target of the ray, pseudo-Cartesian [M]; at least as far from the hole as `from`.
  Vector3<double> position;
  double near_enough;
};

//! Turns a direction at `camera` by Newton's method until its ray comes to the target. Returns
//! false if no ray does, or if the ray goes another way round the hole.
ERGO_HD bool aim_at(const CameraStation& camera, const RayTarget& target, Vector3<double>& direction, Miss& miss) {
  constexpr double longest_step = 0.3;
  for (int round = 0; round < max_aim_rounds; ++round) {
    Vector3<double> axes[2];
    const Vector3<double>& d = direction;
    axes_across(d, axes[0], axes[1]);
    const Vector3<Dual<double>> n = {
        {d.x, axes[0].x, axes[1].x}, {d.y, axes[0].y, axes[1].y}, {d.z, axes[0].z, axes[1].z}};
    if (!miss_of(camera, target, n, miss)) {
      return false;
    }
    const double size = ::sqrt(miss.step[0] * miss.step[0] + miss.step[1] * miss.step[1]);
    const double share = size > longest_step ? longest_step / size : 1.0;
    direction = normalized(d + share * (miss.step[0] * axes[0] + miss.step[1] * axes[1]));
    if (miss.same_side && miss.size < target.near_enough) {
      return !miss.mirrored;
    }
  }
  return false;
}

//! Finds the ray from the direction without spin. Tries the correction that was found for a nearby
//! target; if that fails, raises the spin to the frame's in steps. `correction` is what the spin
//! adds to the direction: on input for a nearby target, on output for this one. If no ray is found,
//! returns false with a correction of 0.
ERGO_HD bool aim_with_spin(const LocalFrame& frame, const RayEnds& ends, Vector3<double>& direction,
                           RayCorrection& correction, Miss& miss) {
  constexpr int raises = 6;
  const RayTarget target = ray_target(ends.from, ends.position, ends.near_enough);
  const Vector3<double> start = direction;
  direction = normalized(start + correction.direction);
  bool found = aim_at(frame.camera, target, direction, miss);
  if (!found) {
    direction = start;
    found = true;
    for (int i = 1; i <= raises && found; ++i) {
      found = aim_at(local_frame(Spacetime{frame.camera.spin * i / raises}, ends.from).camera, target, direction, miss);
    }
  }
  correction.direction = found ? direction - start : Vector3<double>{0.0, 0.0, 0.0};
  return found;
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
