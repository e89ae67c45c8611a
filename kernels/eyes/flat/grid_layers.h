#pragma once

#include "kernels/disk/disk_chart.h"
#include "kernels/eyes/flat/ray_layers.h"

namespace ergodome::inline ERGO_TARGET {

//! Layers of the disk, interpolated in a grid that was traced from the head. Each leaf of the grid
//! holds one bicubic patch.
template <class T, bool WithPattern>
class GridLayers {
 public:
  using D = Dual<T>;
  using Mask = MaskOf<T>;

  ERGO_HD explicit GridLayers(const FlatEyeLookUpBatch& batch) : batch_(batch), lanes_(0.0F), left_(0.0F) {}

  //! Evaluates the layers in direction n. Where the grid's leaf is flagged, no layer is shown, and
  //! rays must be traced for the lane (left()) if any order may be visible there.
  ERGO_HD void aim(const Vector3<D>& n, int, const Mask& lanes) {
    const DiskPosition<T> position =
        disk_position(batch_.grid.cells.chart.edge, rain_direction(batch_.aberration, n, energy_));
    lanes_ = select(lanes, T(1.0F), T(0.0F));
    left_ = T(0.0F);
    Leaf leaf{};
    for (D& nearness : nearness_) {
      nearness = D(T(0.0F));
    }
    for (D& u : u_) {
      u = D(T(batch_.eye.limits.lowest_u));
    }
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      orders_[i] = 0;
      if (!mask_lane(lanes, i)) {
        continue;
      }
      positions_[i] = disk_lane_position(batch_.grid.cells, position, i);
      if (!holds(leaf, positions_[i].gamma_turns, positions_[i].s)) {
        leaf = find_leaf(batch_.grid.cells, positions_[i].gamma_turns, positions_[i].s);
      }
      leaves_[i] = leaf;
      const unsigned orders = batch_.grid.orders[leaf.number];
      if (leaf.flagged) {
        set_lane(left_, i, orders != 0 ? 1.0F : 0.0F);
      } else {
        orders_[i] = orders;
      }
      const PatchValue value = patch(batch_.grid.nearness, i);
      PatchValue positions{};
      if constexpr (!WithPattern) {
        positions = patch(batch_.grid.nodes[0], i);
      }
      for (int order = 0; order < crossing_orders; ++order) {
        put(value, order, i, nearness_[order]);
        if constexpr (!WithPattern) {
          put(positions, order, i, u_[order]);
        }
      }
    }
  }

  [[nodiscard]] ERGO_HD D nearness(int order) const { return nearness_[order] * energy_; }

  [[nodiscard]] ERGO_HD LayerPoint<T> point(int order) {
    LayerPoint<T> point = {WithPattern ? D(T(batch_.eye.limits.lowest_u)) : u_[order], T(0.0F), lanes_ < T(0.0F)};
    T shown(0.0F);
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (!(lane(lanes_, i) > 0.0F)) {
        continue;
      }
      if constexpr (WithPattern) {
        put(patch(batch_.grid.nodes[order], i), 0, i, point.u);
      }
      set_lane(shown, i, (orders_[i] >> static_cast<unsigned>(order) & 1U) != 0U ? 1.0F : 0.0F);
    }
    point.shown = shown > T(0.0F);
    return point;
  }

  //! Returns azimuth and delay of an order in the last direction that was evaluated. The remaining
  //! step to the layer is too small to be visible in clouds.
  [[nodiscard]] ERGO_HD CrossingLayer<T> carry(const Vector3<D>&, int order, const Mask& lanes) {
    CrossingLayer<T> layer = detail::empty_layer(T(0.0F));
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (WithPattern && mask_lane(lanes, i)) {
        const PatchValue value = patch(batch_.grid.nodes[order], i);
        set_lane(layer.cosine, i, quad_part(value.sky, 1));
        set_lane(layer.sine, i, quad_part(value.sky, 2));
        set_lane(layer.delay, i, quad_part(value.sky, 3));
      }
    }
    return layer;
  }

  //! Returns the lanes in which the grid was inaccurate in the last direction, so that rays must be
  //! traced.
  [[nodiscard]] ERGO_HD Mask left(const Mask& lanes) const { return lanes & (left_ > T(0.0F)); }

 private:
  //! Evaluates a set of nodes at a lane's position.
  [[nodiscard]] ERGO_HD PatchValue patch(const float* nodes, int i) const {
    const Leaf& leaf = leaves_[i];
    const LeafPosition within = position_in(leaf, positions_[i].gamma_turns, positions_[i].s);
    return patch_value(nodes, batch_.grid.cells.leaves + 4 * leaf.number, within.u, within.v, leaf.width_turns,
                       leaf.height);
  }

  ERGO_HD void put(const PatchValue& value, int part, int i, D& to) const {
    const float along_gamma = quad_part(value.along_gamma, part);
    const float along_s = quad_part(value.along_s, part);
    set_lane(to.value, i, quad_part(value.sky, part));
    set_lane(to.along_x, i, positions_[i].along_x(along_gamma, along_s));
    set_lane(to.along_y, i, positions_[i].along_y(along_gamma, along_s));
  }

  const FlatEyeLookUpBatch& batch_;
  T lanes_;
  T left_;
  D energy_;
  D nearness_[crossing_orders];
  D u_[WithPattern ? 1 : crossing_orders];  //!< only used if the disk has no pattern
  DiskLanePosition positions_[RealTraits<T>::lane_count];
  unsigned orders_[RealTraits<T>::lane_count];
  Leaf leaves_[RealTraits<T>::lane_count];
};

}  // namespace ergodome::inline ERGO_TARGET
