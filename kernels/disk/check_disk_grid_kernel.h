#pragma once

#include "kernels/disk/disk_miss.h"

namespace ergodome::inline ERGO_TARGET {

//! Compares a disk's grid with traced rays at positions of its chart.
template <class T, bool WithPattern>
struct CheckDiskGrid {
  DiskGridCheckBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const int first = index * lanes;
    const T gamma_turns = load_lanes<T>(batch.gamma_turns, first, batch.count);
    const T s = load_lanes<T>(batch.s, first, batch.count);
    const RaysOfDiskChart<T, WithPattern> rays(batch.camera, batch.observer, batch.pixel, gamma_turns, s);
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      batch.error_px[first + i] = 0.0F;
      const bool near = compare(rays, i, lane(gamma_turns, i), lane(s, i), batch.error_px[first + i]);
      batch.area_px[first + i] = near ? rays.area_px(i) : 0.0F;
    }
  }

 private:
  //! Computes the largest displacement on the screen [px] between the grid and the traced ray at a
  //! position, over all orders. Returns false if no image of the disk is near the position.
  ERGO_HD bool compare(const RaysOfDiskChart<T, WithPattern>& rays, int i, float gamma_turns, float s,
                       float& error_px) const {
    const LensGrid& cells = batch.grid.cells;
    const bool over = cells.mirrored != 0 && gamma_turns > 0.5F;
    const float turns = over ? 1.0F - gamma_turns : gamma_turns;
    const Leaf leaf = find_leaf(cells, turns, s);
    const LeafPosition at = position_in(leaf, turns, s);
    const unsigned orders = batch.grid.orders[leaf.number];
    const DiskMiss<WithPattern> miss = {batch.camera, batch.span};
    bool near = false;
    for (int order = 0; order < crossing_orders; ++order) {
      const float u = lane(rays.layers[order].u, i);
      const bool seen = u > batch.span.outer_u && u < batch.span.inner_u;
      const bool crossed = (orders >> static_cast<unsigned>(order) & 1U) != 0U;
      near = near || seen || crossed;
      if (crossed && !leaf.flagged) {
        PatchValue value = patch_value(batch.grid.nodes[WithPattern ? order : 0], cells.leaves + 4 * leaf.number, at.u,
                                       at.v, leaf.width_turns, leaf.height);
        // The grid covers only half a turn; in the other half, which is its mirror image, γ
        // increases in the opposite direction.
        value.along_gamma = (over ? -1.0F : 1.0F) * value.along_gamma;
        error_px = maximum(error_px, miss.of(value, order, rays.layers[order], i, rays.screen(i)));
      } else if (seen && !crossed) {
        error_px = unknown_disk_error;
      }
    }
    return near;
  }
};

template <class T, class Action>
void dispatch(const DiskGridCheckBatch& batch, const Action& action) {
  if (batch.camera.pattern) {
    action(CheckDiskGrid<T, true>{batch});
  } else {
    action(CheckDiskGrid<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
