#pragma once

#include "kernels/objects/draw_objects.h"
#include "kernels/objects/mesh_emitter.h"

// Functions that all kernels that draw objects share.
namespace ergodome::inline ERGO_TARGET {

ERGO_HD double length_of(const Vector3<double>& v) { return ::sqrt(dot(v, v)); }

//! Returns the observer's direction at a position in the image. N is double, or Dual<double> with
//! the derivatives per pixel.
template <class N>
ERGO_HD Vector3<N> observed_by(const ObjectScene& objects, const N& x_px, const N& y_px) {
  const Vector3<N> view = direction_from_pixel(objects.projection, x_px, y_px);
  const auto row = [&](int i) {
    const double(&m)[3] = objects.frame_from_view[i];
    return view.x * m[0] + view.y * m[1] + view.z * m[2];
  };
  return {row(0), row(1), row(2)};
}

ERGO_HD Vector3<Dual<double>> observed_footprint(const ObjectScene& objects, double x_px, double y_px) {
  return observed_by(objects, Dual<double>(x_px, 1.0, 0.0), Dual<double>(y_px, 0.0, 1.0));
}

}  // namespace ergodome::inline ERGO_TARGET
