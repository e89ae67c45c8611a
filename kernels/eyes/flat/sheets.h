#pragma once

#include "kernels/disk/crossing_layers.h"
#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/near_rays/near_pixels.h"

// What a head sees of the disk in a direction, order by order: a sheet each. By rays, or from a grid (grid_sheets.h). Both look in one direction, and
// then tell of what they have seen there.
namespace ergodome::inline ERGO_TARGET {

//! One order's sheet in a direction of the head's.
template <class T>
struct SheetPoint {
  Dual<T> u;        //!< 1/r [1/M]
  T u_rate;         //!< positive for light that was emitted outwards
  MaskOf<T> shown;  //!< an image may be seen there
};

//! By the layers of crossings, which are smooth beyond the disk's edges, too.
template <class T>
class RaySheets {
 public:
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  ERGO_HD explicit RaySheets(const FlatEyeBatch& batch) : batch_(batch), lanes_(S(0)) {}

  //! Looks in direction n, for the first `orders` sheets.
  ERGO_HD void look(const Vector3<D>& n, int orders, const Mask& lanes) {
    const CameraStationOf<S>& camera = batch_.near_field.pixels.camera;
    trace_layers<near_order, NearParts::distance>(camera.spin, start_near_ray(camera, n), batch_.limits, layers_,
                                                  orders);
    lanes_ = select(lanes, T(S(1)), T(S(0)));
  }

  //! 1 / affine distance of a sheet there [1/M]; 0 where that is no place.
  [[nodiscard]] ERGO_HD D nearness(int order) const {
    const D& distance = layers_[order].distance;
    const auto far = distance.value > T(S(0));
    const D one(T(S(1)));
    return select(far, one / select(far, distance, one), D(T(S(0))));
  }

  //! What else of it is seen there.
  [[nodiscard]] ERGO_HD SheetPoint<T> point(int order) const {
    return {layers_[order].u, layers_[order].u_rate, lanes_ > T(S(0))};
  }

  //! Azimuth and delay of an order in direction n, for clouds.
  ERGO_HD CrossingLayer<T> carry(const Vector3<D>& n, int order, const Mask&) const {
    const CameraStationOf<S>& camera = batch_.near_field.pixels.camera;
    CrossingLayer<T> layers[crossing_orders];
    trace_layers<near_order, NearParts::azimuth_and_delay>(
        camera.spin, start_near_ray(camera, Vector3<T>{n.x.value, n.y.value, n.z.value}), batch_.limits, layers,
        order + 1);
    return layers[order];
  }

  //! Lanes of which nothing is known.
  [[nodiscard]] ERGO_HD Mask left(const Mask& lanes) const { return lanes & !lanes; }

 private:
  const FlatEyeBatch& batch_;
  T lanes_;
  CrossingLayer<D> layers_[crossing_orders];
};

}  // namespace ergodome::inline ERGO_TARGET
