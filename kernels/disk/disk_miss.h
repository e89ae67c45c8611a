#pragma once

#include "kernels/core/lanes.h"
#include "kernels/disk/crossing_layers.h"
#include "kernels/disk/disk_chart.h"
#include "kernels/disk/disk_grid.h"
#include "kernels/lens/lens_grid.h"
#include "kernels/near_rays/near_pixels.h"

// Errors of a disk's grid on the screen, measured by traced rays.
namespace ergodome::inline ERGO_TARGET {

//! Bounds of 1/r between which a grid is checked.
struct CheckedBounds {
  float low;
  float high;
};

//! Returns the bounds between which grids must be accurate: somewhat beyond the disk's edges, so
//! that cells with only a small part inside the disk are checked as well.
ERGO_HD CheckedBounds checked_bounds(const DiskSpanOnScreen& span, const LayerLimits<float>& limits) {
  return {0.6F * span.outer_u, span.inner_u + 0.25F * maximum(limits.near_u - span.inner_u, 0.0F)};
}

//! Converts derivatives in a disk's chart to derivatives on the screen.
struct DiskScreen {
  float scale;            //!< scale of the screen [px/rad]
  float alpha_by_turn;    //!< dα/dγ at constant s [rad/turn]
  float s_per_alpha;      //!< ∂s/∂α [1/rad]
  float turns_per_angle;  //!< turns of γ per angle perpendicular to α [1/rad]

  //! Returns the change across a pixel of a quantity with these derivatives along γ [turns] and s.
  [[nodiscard]] ERGO_HD float across_pixel(float along_gamma, float along_s) const {
    const float outwards = along_s * s_per_alpha;
    const float across = (along_gamma - alpha_by_turn * outwards) * turns_per_angle;
    return ::sqrtf(outwards * outwards + across * across) / scale;
  }
};

namespace detail {

//! Follows the rays of a grid's camera in the directions n.
template <NearParts Parts, class T>
ERGO_HD MaskOf<RealOf<T>> trace_grid_layers(const DiskGridCamera& camera, const Vector3<T>& n,
                                            CrossingLayer<T> (&layers)[crossing_orders]) {
  const CameraStationOf<float>& rays = camera.grid.rays;
  return trace_layers<near_order, Parts>(rays.spin, start_near_ray(rays, n), camera.limits, layers);
}

}  // namespace detail

//! Rays at positions of a disk's chart, and the scale at which an observer sees them.
template <class T, bool WithPattern>
struct RaysOfDiskChart {
  CrossingLayer<T> layers[crossing_orders];
  MaskOf<T> done;  //!< lanes whose ray ended before it reached the step limit
  MixedDual<T> alpha;
  T scale;  //!< scale at which the observer sees each ray [px/rad]
  T sine;   //!< sin α

  ERGO_HD RaysOfDiskChart(const DiskGridCamera& camera, const AberrationOf<float>& observer, float pixel,
                          const T& gamma_turns, const T& s)
      : alpha(disk_polar_angle(camera.grid.chart.edge, gamma_turns, s)) {
    const Vector3<MixedDual<T>> n = chart_direction_at(camera.grid.chart, gamma_turns, alpha);
    const Vector3<T> direction = {n.x.value, n.y.value, n.z.value};
    scale = observed_scale(observer, direction) * (1.0F / pixel);
    T cosine;
    sine_cosine(alpha.value, sine, cosine);
    done = detail::trace_grid_layers<detail::disk_parts(WithPattern)>(camera, direction, layers);
    // At the chart's poles, derivatives along γ are only rounding errors, so the sine by which they
    // are divided has this minimum.
    min_sine_ = 0.02F * camera.grid.chart.edge.smallest;
  }

  [[nodiscard]] ERGO_HD DiskScreen screen(int i) const {
    return {lane(scale, i), lane(alpha.along_x, i), 1.0F / lane(alpha.along_y, i),
            0.159154943F / maximum(::fabsf(lane(sine, i)), min_sine_)};
  }

  //! Returns the area on the screen [px²] of a chart area of one turn of γ times one unit of s,
  //! with the scale at the position of lane `i`.
  [[nodiscard]] ERGO_HD float area_px(int i) const {
    return 6.28318531F * ::fabsf(lane(sine, i) * lane(alpha.along_y, i)) * lane(scale, i) * lane(scale, i);
  }

 private:
  float min_sine_;
};

//! Compares a grid's values for the crossing of one order with those of a traced ray.
template <bool WithPattern>
struct DiskMiss {
  const DiskGridCamera& camera;
  const DiskSpanOnScreen& span;

  //! Returns the index of the patch component that holds an order's 1/r.
  ERGO_HD static int part_of(int order) { return WithPattern ? 0 : order; }

  //! Returns the change of an order's 1/r across a pixel.
  [[nodiscard]] ERGO_HD float width(const PatchValue& read, int order, const DiskScreen& screen) const {
    const int part = part_of(order);
    return screen.across_pixel(quad_part(read.along_gamma, part), quad_part(read.along_s, part));
  }

  //! Returns the displacement on the screen at lane `i` [px] of lines of equal radius or of the
  //! pattern, whichever is larger. Returns 0 if neither the grid's radius nor the traced one is
  //! near the disk.
  template <class T>
  [[nodiscard]] ERGO_HD float of(const PatchValue& read, int order, const CrossingLayer<T>& layer, int i,
                                 const DiskScreen& screen) const {
    const float u = quad_part(read.sky, part_of(order));
    const float traced = lane(layer.u, i);
    const float across = width(read, order, screen);
    const CheckedBounds bounds = checked_bounds(span, camera.limits);
    const float low = bounds.low - across;
    const float high = bounds.high + across;
    if ((u < low && traced < low) || (u > high && traced > high)) {
      return 0.0F;
    }
    float error = ::fabsf(u - traced) / maximum(across, span.min_change);
    if constexpr (WithPattern) {
      error = maximum(error, pattern_error(read, layer, i, screen));
    }
    // If the error is NaN, it counts as unknown.
    return error >= 0.0F ? error : unknown_disk_error;
  }

 private:
  //! Returns the displacement of the pattern along its gradient [px]. An error of the delay counts
  //! as a rotation of the pattern by the flow during that time.
  template <class T>
  [[nodiscard]] ERGO_HD float pattern_error(const PatchValue& read, const CrossingLayer<T>& layer, int i,
                                            const DiskScreen& screen) const {
    const float spin = camera.grid.rays.spin;
    const float u = minimum(maximum(lane(layer.u, i), span.outer_u), span.inner_u);
    const float rotation = 1.0F / (1.0F / (u * ::sqrtf(u)) + spin);
    const float cosine = quad_part(read.sky, 1);
    const float sine = quad_part(read.sky, 2);
    const float turned = ::atan2f(cosine * lane(layer.sine, i) - sine * lane(layer.cosine, i),
                                  cosine * lane(layer.cosine, i) + sine * lane(layer.sine, i));
    // The winding depends on the radius, so an error of the radius also causes an error of the
    // winding.
    const HorizonWinding<float> horizon = horizon_winding(spin, is_within_horizon(camera.grid.rays));
    const float wound = winding_turn(horizon) + rotation * winding_delay(horizon);
    const float read_u = minimum(maximum(quad_part(read.sky, 0), span.outer_u), span.inner_u);
    const float missed = ::fabsf(turned + rotation * (lane(layer.delay, i) - quad_part(read.sky, 3)) +
                                 wound * (winding(horizon, u) - winding(horizon, read_u)));
    const float inverse = 1.0F / (cosine * cosine + sine * sine);
    const auto rate = [&](const Quad& along) {
      return (cosine * quad_part(along, 2) - sine * quad_part(along, 1)) * inverse + rotation * quad_part(along, 3) +
             wound * winding_rate(horizon, u) * quad_part(along, 0);
    };
    const float change = screen.across_pixel(rate(read.along_gamma), rate(read.along_s));
    return missed / maximum(change, span.min_turn);
  }
};

}  // namespace ergodome::inline ERGO_TARGET
