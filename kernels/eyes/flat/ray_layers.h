#pragma once

#include "kernels/disk/crossing_layers.h"
#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/near_rays/near_pixels.h"

// Layers of the disk, one per order, in the directions of a head: from rays, or from a grid
// (grid_layers.h). Both sources evaluate one direction in aim() and then return the results for
// it.
namespace ergodome::inline ERGO_TARGET {

//! One order's layer in a direction of the head.
template <class T>
struct LayerPoint {
  Dual<T> u;  //!< 1/r [1/M]
  //! Rate du/dλ, backwards (λ: Mino time): positive for light that was emitted outwards.
  T u_rate;
  MaskOf<T> shown;  //!< lanes in which an image of the disk of this order may be visible
};

//! Layers from rays: the layers of crossings, which are smooth even beyond the disk's edges.
template <class T>
class RayLayers {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  ERGO_HD explicit RayLayers(const FlatEyeBatch& batch) : batch_(batch), lanes_(S(0)) {}

  //! Evaluates the first `orders` layers in direction n.
  ERGO_HD void aim(const Vector3<D>& n, int orders, const Mask& lanes) {
    const CameraStationOf<S>& camera = batch_.near_field.pixels.camera;
    trace_layers<near_order, NearParts::distance>(camera.spin, start_near_ray(camera, n), batch_.limits, layers_,
                                                  orders);
    lanes_ = select(lanes, T(S(1)), T(S(0)));
  }

  //! Returns 1 / affine distance of a layer [1/M]; 0 where it does not exist.
  [[nodiscard]] ERGO_HD D nearness(int order) const {
    const D& distance = layers_[order].distance;
    const auto far = distance.value > T(S(0));
    const D one(T(S(1)));
    return select(far, one / select(far, distance, one), D(T(S(0))));
  }

  //! Returns the properties of a layer other than its nearness.
  [[nodiscard]] ERGO_HD LayerPoint<T> point(int order) const {
    return {layers_[order].u, layers_[order].u_rate, lanes_ > T(S(0))};
  }

  //! Returns azimuth and delay of an order in direction n, for clouds.
  ERGO_HD CrossingLayer<T> carry(const Vector3<D>& n, int order, const Mask&) const {
    const CameraStationOf<S>& camera = batch_.near_field.pixels.camera;
    CrossingLayer<T> layers[crossing_orders];
    trace_layers<near_order, NearParts::azimuth_and_delay>(
        camera.spin, start_near_ray(camera, Vector3<T>{n.x.value, n.y.value, n.z.value}), batch_.limits, layers,
        order + 1);
    return layers[order];
  }

  //! Returns the lanes for which rays must be traced instead: none, because this source is rays.
  [[nodiscard]] ERGO_HD Mask left(const Mask& lanes) const { return lanes & !lanes; }

 private:
  const FlatEyeBatch& batch_;
  T lanes_;
  CrossingLayer<D> layers_[crossing_orders];
};

}  // namespace ergodome::inline ERGO_TARGET
