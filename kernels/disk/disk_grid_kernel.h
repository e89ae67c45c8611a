#pragma once

#include "kernels/core/lanes.h"
#include "kernels/disk/disk_chart.h"
#include "kernels/disk/disk_miss.h"

// Traces and checks the nodes of a disk's grid.
namespace ergodome::inline ERGO_TARGET {

//! Traces the nodes of a disk's grid with their derivatives by γ and s. Index i covers nodes i *
//! lanes to (i + 1) * lanes - 1.
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
      if constexpr (!WithPattern) {
        plain[3] = plain[7] = plain[11] = plain[15] = 0.0F;
      }
    }
    if (batch.nearness != nullptr) {
      trace_nearness(n, first);
    }
  }

 private:
  //! Computes the inverse affine distances of the nodes (DiskGrid::nearness), by separate rays that
  //! carry only the distance.
  ERGO_HD void trace_nearness(const Vector3<M>& n, int first) const {
    CrossingLayer<M> layers[crossing_orders];
    detail::trace_grid_layers<NearParts::distance>(batch.camera, n, layers);
    for (int i = 0; i < RealTraits<T>::lane_count && first + i < batch.count; ++i) {
      float* const node = batch.nearness + floats_a_node * static_cast<long>(first + i);
      for (int order = 0; order < crossing_orders; ++order) {
        const M& distance = layers[order].distance;
        const auto far = distance.value > T(0.0F);
        const M one(T(1.0F));
        const M q = select(far, one / select(far, distance, one), M(T(0.0F)));
        const bool good = is_number(q, i);
        put(node + order, good ? q : M(T(0.0F)), i, 0.0F);
        if (!good) {
          forget(first + i, order);
        }
      }
      node[3] = node[7] = node[11] = node[15] = 0.0F;
    }
  }

  //! Replaces the crossing of a node whose distance is unknown by one far outside the disk
  //! (lowest_u), so that the checks detect the error.
  ERGO_HD void forget(int node, int order) const {
    float* const position = batch.nodes[WithPattern ? order : 0] + floats_a_node * static_cast<long>(node);
    put(position + (WithPattern ? 0 : order), M(T(0.0F)), 0, batch.camera.limits.lowest_u);
  }

  ERGO_HD static bool is_number(const M& a, int i) {
    return ::fabsf(lane(a.value, i)) + ::fabsf(lane(a.along_x, i)) + ::fabsf(lane(a.along_y, i)) +
               ::fabsf(lane(a.mixed, i)) <
           1e30F;
  }

  //! Writes a number and its derivatives by γ and s. If `otherwise` is not 0, writes `otherwise`
  //! with derivatives 0 instead.
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
      const CellPosition at = position_of(first + i < batch.count ? first + i : batch.count - 1);
      set_lane(gamma_turns, i, at.gamma_turns);
      set_lane(s, i, at.s);
    }
    const RaysOfDiskChart<T, WithPattern> rays(batch.camera, batch.observer, batch.pixel, gamma_turns, s);
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      const float error = compare(first + i, i, rays);
      batch.error_px[first + i] = mask_lane(rays.done, i) && error < unknown_disk_error ? error : unknown_disk_error;
      const GridCell& cell = batch.cells[(first + i) / checks_a_cell];
      batch.area_px[first + i] = rays.area_px(i) * cell.width_turns * cell.height;
    }
  }

 private:
  //! Rounding error of a direction in float [rad]: errors up to this size are not caused by the
  //! grid.
  static constexpr float noise = 4e-7F;

  //! Position of a check in its cell and in the chart.
  struct CellPosition {
    float u;
    float v;
    float gamma_turns;
    float s;
  };

  ERGO_HD CellPosition position_of(int check) const {
    const GridCell& cell = batch.cells[check / checks_a_cell];
    const int which = check % checks_a_cell;
    const float inner = which == 0 ? inner_check : 1.0F - inner_check;
    const bool on_diagonal = which == 0 || which == 5;
    const float u = on_diagonal ? inner : (which == 3 ? 0.0F : (which == 4 ? 1.0F : 0.5F));
    const float v = on_diagonal ? inner : (which == 1 ? 0.0F : (which == 2 ? 1.0F : 0.5F));
    return {u, v, cell.gamma_turns + u * cell.width_turns, cell.s + v * cell.height};
  }

  //! Returns the largest displacement on the screen [px] between grid and traced ray at a check,
  //! over all orders.
  ERGO_HD float compare(int check, int i, const RaysOfDiskChart<T, WithPattern>& rays) const {
    const GridCell& cell = batch.cells[check / checks_a_cell];
    const CellPosition at = position_of(check);
    const auto patch = [&](const float* nodes) {
      return patch_value(nodes, cell.corners, at.u, at.v, cell.width_turns, cell.height);
    };
    const DiskMiss<WithPattern> miss = {batch.camera, batch.span};
    const DiskScreen screen = rays.screen(i);
    PatchValue value = patch(batch.nodes[0]);
    float worst = 0.0F;
    for (int order = 0; order < crossing_orders; ++order) {
      if (WithPattern && order > 0) {
        value = patch(batch.nodes[order]);
      }
      batch.u[order][check] = lane(rays.layers[order].u, i);
      batch.width[order][check] = miss.width(value, order, screen);
      worst = maximum(worst, miss.of(value, order, rays.layers[order], i, screen));
    }
    return maximum(worst - noise * screen.scale, 0.0F);
  }
};

template <class T, class Action>
void dispatch(const DiskNodeBatch& batch, const Action& action) {
  if (batch.camera.pattern) {
    action(TraceDiskNodes<T, true>{batch});
  } else {
    action(TraceDiskNodes<T, false>{batch});
  }
}

template <class T, class Action>
void dispatch(const DiskCheckBatch& batch, const Action& action) {
  if (batch.camera.pattern) {
    action(CheckDiskCells<T, true>{batch});
  } else {
    action(CheckDiskCells<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
