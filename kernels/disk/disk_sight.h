#pragma once

#include "kernels/disk/disk_light.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/near_rays/seen_light.h"

namespace ergodome::inline ERGO_TARGET {

//! The disk as a pack of rays sees it. WithPattern adds azimuth and time, so that a plain disk does
//! not pay for them.
template <class T, bool WithPattern>
class DiskSight {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  //! `pixel`: width of the area that each ray represents, as a fraction of a pixel.
  ERGO_HD DiskSight(const CameraStationOf<S>& camera, const DiskAppearance& appearance, const NearLimits<S>& limits,
                    const NearRay<D>& ray, S pixel)
      : camera_(camera), appearance_(appearance), limits_(limits), ray_(ray), pixel_(pixel) {}

  //! Traces the rays of a mask's lanes to their crossings of the disk's plane.
  ERGO_HD void trace(const Mask& lanes) {
    const Mask wanted = lanes & may_reach(camera_.spin, ray_, appearance_.outer_r);
    // Rays end at the smaller of two u, one outside the disk and one outside the photon orbits:
    // beyond these no light turns back to the hole.
    const CrossingLimits<S> limits = {minimum(S(0.5) / appearance_.outer_r, S(0.22)), limits_.tolerance,
                                      limits_.step_limit};
    trace_crossings<near_order, false>(camera_.spin, ray_, limits, wanted, crossings_);
    if constexpr (WithPattern) {
      trace_pattern(limits, wanted);
    }
  }

  //! Returns the Mino time from a crossing of lane `i` to the camera; infinity if the lane has no
  //! such crossing.
  ERGO_HD S time(int order, int i) const {
    return order < crossing_orders && is_crossing(crossings_[order], i) ? lane(crossings_[order].time, i)
                                                                        : std::numeric_limits<S>::infinity();
  }

  //! Composites the disk's light at the crossing of an order behind everything that lane `i` has
  //! seen so far.
  ERGO_HD void compose(int order, int i, SeenLanes<T>& seen) const {
    SeenCrossing at = seen_at(crossings_[order], i);
    const float opacity = appearance_.opacity * at.coverage;
    // Also true for a NaN opacity, which then hides nothing.
    if (!(opacity > 0.0F)) {
      return;
    }
    const PhotonConstants photon = {lane(ray_.energy.value, i), lane(ray_.axial_angular_momentum.value, i),
                                    lane(ray_.shear_constant.value, i), lane(ray_.carter.value, i)};
    if (comes_from_behind(order, i, photon, at)) {
      return;
    }
    if constexpr (WithPattern) {
      const EquatorialCrossing<T>& there = carried_[order];
      at.phi = ::atan2f(lane(there.y, i), lane(there.x, i)) + lane(there.drag, i) +
               ::atan2f(camera_.sine_phi, camera_.cosine_phi);
      at.delay = lane(there.delay, i);
    }
    put_behind(opacity * disk_light(appearance_, photon, at), opacity, i, seen);
  }

  //! Returns whether the ray of lane `i` may see images of the disk that are finer than the width
  //! that it represents.
  ERGO_HD bool is_fine(int i) const {
    bool fine = false;
    for (const EquatorialCrossing<D>& crossing : crossings_) {
      fine = fine || (is_crossing(crossing, i) && holds_finer(appearance_, change(crossing, i)));
    }
    return fine;
  }

 private:
  ERGO_HD static bool is_crossing(const EquatorialCrossing<D>& crossing, int i) {
    const S u = lane(crossing.u.value, i);
    return u < S(0) || u > S(0);
  }

  //! Returns the change of 1/r across a pixel.
  ERGO_HD static float change(const EquatorialCrossing<D>& crossing, int i) {
    const float along_x = lane(crossing.u.along_x, i);
    const float along_y = lane(crossing.u.along_y, i);
    return sqrt(along_x * along_x + along_y * along_y);
  }

  //! Returns what lane `i` sees of the disk at a crossing.
  ERGO_HD SeenCrossing seen_at(const EquatorialCrossing<D>& crossing, int i) const {
    const float width = pixel_ * change(crossing, i);
    const detail::DiskSpan span =
        detail::disk_span(appearance_.inner_r, appearance_.outer_r, lane(crossing.u.value, i), width);
    return {span.coverage, span.r, width * span.r, lane(crossing.u_rate.value, i) > 0.0F, 0.0F, 0.0F};
  }

  //! Returns whether lane `i` crosses the disk's plane behind the horizon, while linear
  //! extrapolation puts the part of the disk that its pixel sees at a radius where its light cannot
  //! exist. Only happens with disks that reach inside the innermost stable orbit.
  ERGO_HD bool comes_from_behind(int order, int i, const PhotonConstants& photon, const SeenCrossing& at) const {
    return appearance_.inner_r < appearance_.flow.stable_r &&
           lane(crossings_[order].u.value, i) * camera_.horizon_r > S(1) &&
           !can_be_there<float>(appearance_.flow.spin, {at.r, photon.energy, photon.axial_angular_momentum,
                                                        photon.shear_constant, at.outwards});
  }

  //! Traces azimuth and time at the crossings of those lanes that see the disk.
  ERGO_HD void trace_pattern(const CrossingLimits<S>& limits, const Mask& wanted) {
    T covered(S(0));
    for (const EquatorialCrossing<D>& crossing : crossings_) {
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        if (mask_lane(wanted, i) && is_crossing(crossing, i) && seen_at(crossing, i).coverage > 0.0F) {
          set_lane(covered, i, S(1));
        }
      }
    }
    trace_crossings<near_order, true>(camera_.spin, plain_ray(ray_), limits, covered > T(S(0)), carried_);
  }

  const CameraStationOf<S>& camera_;
  const DiskAppearance& appearance_;
  NearLimits<S> limits_;
  const NearRay<D>& ray_;
  S pixel_;
  EquatorialCrossing<D> crossings_[crossing_orders];
  EquatorialCrossing<T> carried_[crossing_orders];
};

}  // namespace ergodome::inline ERGO_TARGET
