#pragma once

#include "kernels/near_rays/near_pixels.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/shells/shell_crossings.h"
#include "kernels/shells/shell_light.h"

namespace ergodome::inline ERGO_TARGET {

//! Shells as a pack of rays sees them: a visitor of trace_shells. before(lane, time) is called
//! before each crossing, to add things that are nearer.
template <class T, class Before>
class ShellSight {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  //! `pixel`: width of the area that each ray represents, as a fraction of a pixel.
  ERGO_HD ShellSight(const CameraStationOf<S>& camera, const ShellTable& shells, const NearRay<D>& ray, S pixel,
                     const Before& before, SeenLanes<T>& seen)
      : camera_(camera), shells_(shells), ray_(ray), pixel_(pixel), before_(before), seen_(seen), fine_(S(0)) {}

  ERGO_HD void cross(int shell, const Mask& lanes, const NearPosition<D>& position) {
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(lanes, i)) {
        before_(i, lane(position.time, i));
        compose(shell, position, i);
      }
    }
  }

  //! Marks pixels that need more samples than the one in their middle: those next to the edge of a
  //! shell and to the critical curve.
  ERGO_HD void turn(const Mask& lanes, const NearPosition<D>& position) {
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (!mask_lane(lanes, i)) {
        continue;
      }
      const float along_x = lane(position.u.along_x, i);
      const float along_y = lane(position.u.along_y, i);
      const float change = pixel_ * sqrt(along_x * along_x + along_y * along_y);
      const float u = lane(position.u.value, i);
      bool fine = u < shells_.u[shells_.count - 1] && footprint_width(footprint_of(position, i)) > fine_width;
      for (int shell = 0; shell < shells_.count; ++shell) {
        fine = fine || ::fabsf(u - shells_.u[shell]) < change;
      }
      set_lane(fine_, i, fine ? S(1) : lane(fine_, i));
    }
  }

  //! Returns the lanes that are opaque so far, so that nothing farther away is visible.
  ERGO_HD Mask done() const { return seen_.clear < T(opaque); }

  //! Returns the lanes that need more samples than the one in their middle.
  ERGO_HD Mask fine() const { return fine_ > T(S(0)); }

 private:
  //! A footprint as wide as this [rad] contains more than one image, or nearly so.
  static constexpr float fine_width = 0.5F;
  //! If less than this fraction of the light behind is transmitted, a display shows none of it.
  static constexpr S opaque = S(1.0 / 4096.0);

  //! Returns the footprint on the shell of the area that the ray of lane `i` represents, with the
  //! camera's azimuth added.
  ERGO_HD ShellFootprint footprint_of(const NearPosition<D>& position, int i) const {
    const float drag = lane(position.drag.value, i);
    const float c = ::cosf(drag);
    const float s = ::sinf(drag);
    const float cosine = c * camera_.cosine_phi - s * camera_.sine_phi;
    const float sine = s * camera_.cosine_phi + c * camera_.sine_phi;
    const auto turned = [&](T D::*part) {
      const float x = lane(position.m.x.*part, i);
      const float y = lane(position.m.y.*part, i);
      return Vector3<float>{cosine * x - sine * y, sine * x + cosine * y, lane(position.m.z.*part, i)};
    };
    const Vector3<float> d = turned(&D::value);
    const auto derivative = [&](T D::*part) {
      const float turn = lane(position.drag.*part, i);
      const Vector3<float> plain = turned(part);
      return pixel_ * Vector3<float>{plain.x - turn * d.y, plain.y + turn * d.x, plain.z};
    };
    return {d, derivative(&D::along_x), derivative(&D::along_y)};
  }

  ERGO_HD void compose(int shell, const NearPosition<D>& position, int i) {
    const ShellAppearance& appearance = shells_.appearances[shell];
    const ShellFootprint at = footprint_of(position, i);
    if (!(footprint_width(at) < fine_width)) {
      set_lane(fine_, i, S(1));
    }
    float g = 1.0F;
    if (shells_.shifted) {
      const Vector3<float>& d = at.direction;
      const float frequency = zamo_frequency(camera_.spin, appearance.r, sqrt(d.x * d.x + d.y * d.y), d.z,
                                             lane(ray_.energy.value, i), lane(ray_.axial_angular_momentum.value, i));
      g = 1.0F / maximum(frequency, 1e-6F);
    }
    const CoveredLight light = shell_light(appearance, at, g, shells_.shifted);
    // False for a NaN opacity, which then hides nothing.
    if (light.opacity > 0.0F) {
      put_behind(light.light, light.opacity, i, seen_);
    }
  }

  const CameraStationOf<S>& camera_;
  const ShellTable& shells_;
  const NearRay<D>& ray_;
  S pixel_;
  const Before& before_;
  SeenLanes<T>& seen_;
  T fine_;
};

}  // namespace ergodome::inline ERGO_TARGET
