#pragma once

#include "kernels/disk/layer_light.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/eyes/flat/ray_layers.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds where a register of an eye's lines of sight meets the disk, layer by layer. `Layers` is
//! the source of the layers: rays or a grid (kernels/eyes/flat/ray_layers.h).
template <class T, class Layers>
class FlatDisk {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  //! `pixel` is the width that each line covers, as a fraction of a pixel.
  ERGO_HD FlatDisk(const FlatEyeBatch& batch, Layers& layers, const EyeLine<T>& line, const LayerSearch<S>& search,
                   S pixel)
      : batch_(batch), layers_(layers), line_(line), search_(search), pixel_(pixel) {}

  //! Finds the images of the disk that the given lanes see. Returns the lanes in which the source
  //! of the layers is an inaccurate grid, so that rays must be traced.
  ERGO_HD Mask meet(const Mask& lanes) {
    const EyePoint<T> start = line_.at(T(S(0)));
    layers_.aim(start.n, crossing_orders, lanes);
    // Where the source of the layers is inaccurate, so that rays must be traced, every order may be
    // visible.
    const Mask unknown = layers_.left(lanes);
    for (int order = 0; order < crossing_orders; ++order) {
      const D q = layers_.nearness(order);
      const T slope = S(1) - start.by_nearness(q) - q.value * start.closing;
      guess_[order] = select(lanes & (unknown | may_show(start, q.value, layers_.point(order).u)),
                             q.value / maximum(slope, T(S(0.25))), T(S(-1)));
    }
    return meet_near_guesses(lanes);
  }

  //! Does the same as meet(), but its first guesses are the nearnesses that `other` has found from
  //! its source of layers.
  template <class OtherLayers>
  ERGO_HD Mask meet_near(const FlatDisk<T, OtherLayers>& other, const Mask& lanes) {
    return meet_near(other.guess_, lanes);
  }
  ERGO_HD Mask meet_near(const T (&guesses)[crossing_orders], const Mask& lanes) {
    for (int order = 0; order < crossing_orders; ++order) {
      guess_[order] = guesses[order];
    }
    return meet_near_guesses(lanes);
  }

  //! Returns the nearness (1/distance) at which each line meets an order's layer; negative if no
  //! image of that order can be visible near the line.
  [[nodiscard]] ERGO_HD const T& guess(int order) const { return guess_[order]; }

  //! Returns the nearness of an order's image in lane `i`; negative if it is not visible.
  [[nodiscard]] ERGO_HD S nearness(int order, int i) const { return lane(nearness_[order], i); }

  //! Composites an order's image of the disk behind everything that lane `i` has seen so far.
  ERGO_HD void compose(int order, int i, SeenLanes<T>& seen) const {
    const CrossingLayer<T>& carried = carried_[order];
    const SeenLayer at = {lane(u_[order].value, i), pixel_ * change(order, i), lane(carried.cosine, i),
                          lane(carried.sine, i),    lane(carried.delay, i),    lane(carried.u_rate, i) > S(0)};
    const NearFieldBatch& scene = batch_.near_field;
    const PhotonConstants photon = photon_constants(rays_[order], i);
    if (scene.drawing == DiskDrawing::pattern) {
      put_layer_behind<true>(scene.pixels.camera, scene.disk, at, photon, i, seen);
    } else {
      put_layer_behind<false>(scene.pixels.camera, scene.disk, at, photon, i, seen);
    }
  }

  //! Composites images of the disk behind everything that lane `i` has seen so far, from order
  //! `next` on. Stops at the first order whose image is farther than `nearness`, and sets `next` to
  //! that order.
  ERGO_HD void compose_before(S nearness, int i, int& next, SeenLanes<T>& seen) const {
    for (; next < crossing_orders; ++next) {
      const S own = this->nearness(next, i);
      if (own > S(0) && own < nearness) {
        return;
      }
      if (own > S(0)) {
        compose(next, i, seen);
      }
    }
  }

  //! Returns whether images may contain detail finer than the width that each line covers.
  [[nodiscard]] ERGO_HD bool is_fine(int i) const {
    bool fine = false;
    for (int order = 0; order < crossing_orders; ++order) {
      fine = fine || (nearness(order, i) > S(0) && holds_finer(batch_.near_field.disk, change(order, i)));
    }
    return fine;
  }

 private:
  template <class, class>
  friend class FlatDisk;

  //! Returns the lanes whose line may meet the disk. The head's u in direction m, plus or minus its
  //! estimated change on the way to the layer, is compared with the disk's edges.
  ERGO_HD Mask may_show(const EyePoint<T>& start, const T& nearness, const D& u) const {
    const DiskAppearance& disk = batch_.near_field.disk;
    const T way = nearness * absolute(start.by_nearness(u));
    const T width = absolute(u.along_x) + absolute(u.along_y);
    const T margin = S(2) * (way + width) + T(S(0.2) / disk.inner_r);
    // If a layer is this near, the change of u on the way cannot be estimated, so the line counts
    // as possibly meeting the disk.
    const auto near = nearness * sqrt(dot(line_.eye, line_.eye)) > T(S(0.1));
    return near | ((u.value < T(S(1) / disk.inner_r) + margin) & (u.value > T(S(1) / disk.outer_r) - margin));
  }

  ERGO_HD Mask meet_near_guesses(const Mask& lanes) {
    Mask left = lanes & !lanes;
    for (int order = 0; order < crossing_orders; ++order) {
      nearness_[order] = T(S(-1));
      const Mask wanted = lanes & (guess_[order] >= T(S(0)));
      if (any(wanted)) {
        left = left | meet_order(order, wanted);
      }
    }
    return left;
  }

  ERGO_HD Mask meet_order(int order, const Mask& wanted) {
    const MetLayer<T> met =
        meet_layer(line_, guess_[order], search_, wanted, [&](const EyePoint<T>& point, const Mask& lanes) {
          layers_.aim(point.n, order + 1, lanes);
          return layers_.nearness(order);
        });
    const Mask left = layers_.left(wanted);
    const LayerPoint<T> found = layers_.point(order);
    u_[order] = met.carried(found.u);
    const Vector3<D> n = met.direction();
    rays_[order] = start_near_ray(batch_.near_field.pixels.camera, Vector3<T>{n.x.value, n.y.value, n.z.value});
    guess_[order] = select(wanted, met.nearness(), guess_[order]);
    nearness_[order] = select(met.met & found.shown, met.nearness(), T(S(-1)));
    hide(order, wanted);
    const Mask seen = wanted & sees_disk(order);
    const bool clouds = batch_.near_field.drawing == DiskDrawing::pattern && any(seen);
    carried_[order] = clouds ? layers_.carry(n, order, seen) : detail::empty_layer(T(S(0)));
    carried_[order].u_rate = found.u_rate;
    return left;
  }

  //! Removes images behind the horizon: the eye's shadow differs from the head's by a crescent, in
  //! which the head's rays still see the disk.
  ERGO_HD void hide(int order, const Mask& lanes) {
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(lanes, i) && nearness(order, i) > S(0) &&
          is_behind_horizon(batch_.horizon, line_.direction(i), nearness(order, i))) {
        set_lane(nearness_[order], i, S(-1));
      }
    }
  }

  //! Returns the lanes in which the disk covers at least part of the line's width.
  [[nodiscard]] ERGO_HD Mask sees_disk(int order) const {
    const DiskAppearance& disk = batch_.near_field.disk;
    T covered(S(0));
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      const float u = lane(u_[order].value, i);
      const float width = pixel_ * change(order, i);
      if (nearness(order, i) > S(0) && detail::disk_span(disk.inner_r, disk.outer_r, u, width).coverage > 0.0F) {
        set_lane(covered, i, S(1));
      }
    }
    return covered > T(S(0));
  }

  //! Returns the change of 1/r across a pixel.
  [[nodiscard]] ERGO_HD float change(int order, int i) const {
    const float along_x = lane(u_[order].along_x, i);
    const float along_y = lane(u_[order].along_y, i);
    return sqrt(along_x * along_x + along_y * along_y);
  }

  const FlatEyeBatch& batch_;
  Layers& layers_;
  const EyeLine<T>& line_;
  LayerSearch<S> search_;
  S pixel_;
  T guess_[crossing_orders];
  T nearness_[crossing_orders];
  D u_[crossing_orders];
  CrossingLayer<T> carried_[crossing_orders];
  NearRay<T> rays_[crossing_orders];
};

}  // namespace ergodome::inline ERGO_TARGET
