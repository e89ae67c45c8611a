#pragma once

#include "kernels/core/lanes.h"
#include "kernels/disk/crossing_layers.h"
#include "kernels/disk/disk_chart.h"
#include "kernels/disk/disk_grid.h"
#include "kernels/near_field/near_pixels.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Follows the ray of a direction of a grid's camera.
template <NearParts Parts, class T>
ERGO_HD MaskOf<RealOf<T>> trace_grid_layers(const DiskGridCamera& camera, const Vector3<T>& n,
                                            CrossingLayer<T> (&layers)[crossing_orders]) {
  const CameraStationOf<float>& rays = camera.grid.rays;
  return trace_layers<near_order, Parts>(rays.spin, start_near_ray(rays, n), camera.limits, layers);
}

}  // namespace detail

//! Bounds of 1/r.
struct CheckedBounds {
  float low;
  float high;
};

//! Between these grids are held to be good: some way beyond the disk's edges, for the sake of cells of which little is within.
ERGO_HD CheckedBounds checked_bounds(const DiskSpanOnScreen& span, const LayerLimits<float>& limits) {
  return {0.6F * span.outer_u, span.inner_u + 0.25F * maximum(limits.near_u - span.inner_u, 0.0F)};
}

//! Traces the nodes of a disk's grid with their derivatives; index i stands for the nodes i * lanes, i * lanes + 1, ...
template <class T, bool WithPattern>
struct TraceDiskNodes {
  using M = MixedDual<T>;
  DiskNodeBatch batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const T gamma_turns = load_lanes<T>(batch.gamma_turns, first, batch.count);
    const T s = load_lanes<T>(batch.s, first, batch.count);
    const LensChart& chart = batch.camera.grid.chart;
    const Vector3<M> n = chart_direction_at(chart, gamma_turns, disk_polar_angle(chart.edge, gamma_turns, s));
    CrossingLayer<M> layers[crossing_orders];
    detail::trace_grid_layers<detail::disk_parts(WithPattern)>(batch.camera, n, layers);
    for (int i = 0; i < RealTraits<T>::lane_count && first + i < batch.count; ++i) {
      float* const plain = batch.nodes[0] + floats_a_node * static_cast<long>(first + i);
      for (int order = 0; order < crossing_orders; ++order) {
        if constexpr (WithPattern) {
          store(batch.nodes[order] + floats_a_node * static_cast<long>(first + i), layers[order], i);
        } else {
          put(plain + order, layers[order].u, i, is_number(layers[order].u, i) ? 0.0F : batch.camera.limits.lowest_u);
        }
      }
    }
  }

 private:
  ERGO_HD static bool is_number(const M& a, int i) {
    return ::fabsf(lane(a.value, i)) + ::fabsf(lane(a.along_x, i)) + ::fabsf(lane(a.along_y, i)) +
               ::fabsf(lane(a.mixed, i)) <
           1e30F;
  }

  //! A number and its derivatives, or where it is none `otherwise`, if that is not 0.
  ERGO_HD static void put(float* to, const M& a, int i, float otherwise) {
    const bool good = !(::fabsf(otherwise) > 0.0F);
    to[0] = good ? lane(a.value, i) : otherwise;
    to[4] = good ? lane(a.along_x, i) : 0.0F;
    to[8] = good ? lane(a.along_y, i) : 0.0F;
    to[12] = good ? lane(a.mixed, i) : 0.0F;
  }

  ERGO_HD void store(float* node, const CrossingLayer<M>& layer, int i) const {
    const bool good =
        is_number(layer.u, i) && is_number(layer.cosine, i) && is_number(layer.sine, i) && is_number(layer.delay, i);
    const float none = good ? 0.0F : batch.camera.limits.lowest_u;
    put(node, layer.u, i, none);
    put(node + 1, layer.cosine, i, none);
    put(node + 2, layer.sine, i, none);
    put(node + 3, layer.delay, i, none);
  }
};

//! Compares cells of a disk's grid with traced rays.
template <class T, bool WithPattern>
struct CheckDiskCells {
  DiskCheckBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const int first = index * lanes;
    T gamma_turns(0.0F);
    T s(0.0F);
    for (int i = 0; i < lanes; ++i) {
      const CellPlace at = place_of(first + i < batch.count ? first + i : batch.count - 1);
      set_lane(gamma_turns, i, at.gamma_turns);
      set_lane(s, i, at.s);
    }
    const LensChart& chart = batch.camera.grid.chart;
    const MixedDual<T> alpha = disk_polar_angle(chart.edge, gamma_turns, s);
    const Vector3<MixedDual<T>> n = chart_direction_at(chart, gamma_turns, alpha);
    const Vector3<T> direction = {n.x.value, n.y.value, n.z.value};
    const T scale = observed_scale(batch.observer, direction) * (1.0F / batch.pixel);
    T sine;
    T cosine;
    sine_cosine(alpha.value, sine, cosine);
    CrossingLayer<T> layers[crossing_orders];
    const MaskOf<T> done = detail::trace_grid_layers<detail::disk_parts(WithPattern)>(batch.camera, direction, layers);
    // At the chart's poles derivatives along γ are rounding, and mean nothing.
    const float least_sine = 0.02F * chart.edge.smallest;
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      const Screen screen = {lane(scale, i), lane(alpha.along_x, i), 1.0F / lane(alpha.along_y, i),
                             0.159154943F / maximum(::fabsf(lane(sine, i)), least_sine)};
      const float error = compare(first + i, i, screen, layers);
      batch.error_px[first + i] = mask_lane(done, i) && error < huge ? error : huge;
      const GridCell& cell = batch.cells[(first + i) / checks_a_cell];
      batch.area_px[first + i] = 6.28318531F * ::fabsf(lane(sine, i) * lane(alpha.along_y, i)) * cell.width_turns *
                                 cell.height * screen.scale * screen.scale;
    }
  }

 private:
  static constexpr float huge = 1e30F;
  //! What float leaves of a direction [rad]: errors of this size are not the grid's.
  static constexpr float noise = 4e-7F;

  //! Where a check lies in its cell, and in the chart.
  struct CellPlace {
    float u;
    float v;
    float gamma_turns;
    float s;
  };

  //! What leads from derivatives in the chart to those on the screen.
  struct Screen {
    float scale;            //!< [px/rad]
    float alpha_by_turn;    //!< dα/dγ
    float s_per_alpha;      //!< [1/rad]
    float turns_per_angle;  //!< across [1/rad]

    //! The change across a pixel of what changes so along γ [turns] and s.
    [[nodiscard]] ERGO_HD float across_pixel(float along_gamma, float along_s) const {
      const float outwards = along_s * s_per_alpha;
      const float across = (along_gamma - alpha_by_turn * outwards) * turns_per_angle;
      return ::sqrtf(outwards * outwards + across * across) / scale;
    }
  };

  ERGO_HD CellPlace place_of(int check) const {
    const GridCell& cell = batch.cells[check / checks_a_cell];
    const int which = check % checks_a_cell;
    const float inner = which == 0 ? inner_check : 1.0F - inner_check;
    const bool on_diagonal = which == 0 || which == 5;
    const float u = on_diagonal ? inner : (which == 3 ? 0.0F : (which == 4 ? 1.0F : 0.5F));
    const float v = on_diagonal ? inner : (which == 1 ? 0.0F : (which == 2 ? 1.0F : 0.5F));
    return {u, v, cell.gamma_turns + u * cell.width_turns, cell.s + v * cell.height};
  }

  //! The greatest displacement of all orders at a check.
  ERGO_HD float compare(int check, int i, const Screen& screen,
                        const CrossingLayer<T> (&layers)[crossing_orders]) const {
    const GridCell& cell = batch.cells[check / checks_a_cell];
    const CellPlace at = place_of(check);
    const auto patch = [&](const float* nodes) {
      return patch_value(nodes, cell.corners, at.u, at.v, cell.width_turns, cell.height);
    };
    PatchValue value = patch(batch.nodes[0]);
    float worst = 0.0F;
    for (int order = 0; order < crossing_orders; ++order) {
      if (WithPattern && order > 0) {
        value = patch(batch.nodes[order]);
      }
      const int part = WithPattern ? 0 : order;
      const float read = quad_part(value.sky, part);
      const float traced = lane(layers[order].u, i);
      const float width = screen.across_pixel(quad_part(value.along_gamma, part), quad_part(value.along_s, part));
      batch.u[order][check] = traced;
      batch.width[order][check] = width;
      const CheckedBounds bounds = checked_bounds(batch.span, batch.camera.limits);
      const float low = bounds.low - width;
      const float high = bounds.high + width;
      if ((read < low && traced < low) || (read > high && traced > high)) {
        continue;
      }
      float error = ::fabsf(read - traced) / maximum(width, batch.span.least_change);
      if constexpr (WithPattern) {
        error = maximum(error, pattern_error(value, layers[order], i, screen));
      }
      // A number that is none is no less than any other.
      worst = error >= 0.0F ? maximum(worst, error) : huge;
    }
    return maximum(worst - noise * screen.scale, 0.0F);
  }

  //! How far the pattern is displaced along its own gradient: it is turned with the flow by as much as its light is late.
  ERGO_HD float pattern_error(const PatchValue& read, const CrossingLayer<T>& layer, int i,
                              const Screen& screen) const {
    const float u = minimum(maximum(lane(layer.u, i), batch.span.outer_u), batch.span.inner_u);
    const float rotation = 1.0F / (1.0F / (u * ::sqrtf(u)) + batch.camera.grid.rays.spin);
    const float cosine = quad_part(read.sky, 1);
    const float sine = quad_part(read.sky, 2);
    const float turned = ::atan2f(cosine * lane(layer.sine, i) - sine * lane(layer.cosine, i),
                                  cosine * lane(layer.cosine, i) + sine * lane(layer.sine, i));
    // Where the radius is wrong, so is what the horizon winds there.
    const HorizonWinding<float> horizon = horizon_winding(batch.camera.grid.rays.spin);
    const float wound = winding_turn(horizon) + rotation * winding_delay(horizon);
    const float read_u = minimum(maximum(quad_part(read.sky, 0), batch.span.outer_u), batch.span.inner_u);
    const float missed = ::fabsf(turned + rotation * (lane(layer.delay, i) - quad_part(read.sky, 3)) +
                                 wound * (winding(horizon, u) - winding(horizon, read_u)));
    const float inverse = 1.0F / (cosine * cosine + sine * sine);
    const auto rate = [&](const Quad& along) {
      return (cosine * quad_part(along, 2) - sine * quad_part(along, 1)) * inverse + rotation * quad_part(along, 3) +
             wound * winding_rate(horizon, u) * quad_part(along, 0);
    };
    const float change = screen.across_pixel(rate(read.along_gamma), rate(read.along_s));
    return missed / maximum(change, batch.span.least_turn);
  }
};

}  // namespace ergodome::inline ERGO_TARGET
