#pragma once

#include <cstdint>

#include "kernels/core/dual.h"
#include "kernels/core/transcendental.h"
#include "kernels/core/vector3.h"

// An overlay's shape and position on the sphere of directions.
namespace ergodome {

//! How an overlay lies on the sphere of directions.
//!
//! `bent`: along a circle of latitude, so that a wide line of text stays level. x is the azimuth
//! and y Mercator's latitude, both times the cosine of the middle's latitude. This is conformal, so
//! letters keep their shape. `flat`: on the plane that touches the sphere in the overlay's middle.
//! `fisheye`: an equidistant domemaster.
enum class OverlayShape : std::int32_t { bent, flat, fisheye };

//! Position of an overlay. Its axes are unit vectors in those of the view (x right, y up, z back).
struct OverlaySurface {
  OverlayShape shape;
  Vector3<float> across;  //!< direction to the overlay's right, at its middle
  Vector3<float> up;      //!< bent: the pole of its latitudes; flat: upwards; fisheye: the zenith
  //! Direction to azimuth 0 on the equator of its latitudes (bent), to its middle (flat), or to the
  //! horizon at the dome's front (fisheye).
  Vector3<float> ahead;
  //! Bent: cosine of the middle's latitude; fisheye: half the field of view [rad].
  float scale;
  float middle;  //!< bent: Mercator's latitude of the middle
  //! Bent: the range of azimuths that it covers, times `scale` [rad]; flat: its width on the plane
  //! at distance 1.
  float width;
  float height;
  Vector3<float> bound_axis;  //!< axis of a cone that contains the whole overlay
  float bound_cosine;         //!< cosine of the cone's half angle
};

inline namespace ERGO_TARGET {

namespace detail {
template <class T>
ERGO_HD Dual<T> arc_tangent_of(const Dual<T>& y, const Dual<T>& x) {
  const T inverse = ScalarOf<T>(1) / (x.value * x.value + y.value * y.value);
  return {arc_tangent(y.value, x.value), (x.value * y.along_x - y.value * x.along_x) * inverse,
          (x.value * y.along_y - y.value * x.along_y) * inverse};
}

//! Returns artanh(a), for -1 < a < 1.
template <class T>
ERGO_HD Dual<T> area_tangent_of(const Dual<T>& a) {
  const T slope = T(1.0F) / (T(1.0F) - a.value * a.value);
  return {T(0.5F) * natural_logarithm((T(1.0F) + a.value) / (T(1.0F) - a.value)), slope * a.along_x, slope * a.along_y};
}
}  // namespace detail

//! Computes the position (s, t) of a direction on a surface, 0 to 1 from the left and from the top.
//! Only meaningful within the surface's bound.
template <class T>
ERGO_HD void project_to_surface(const OverlaySurface& surface, const Vector3<Dual<T>>& view, Dual<T>& s, Dual<T>& t) {
  using D = Dual<T>;
  const auto along = [&](const Vector3<float>& axis) {
    return view.x * T(axis.x) + view.y * T(axis.y) + view.z * T(axis.z);
  };
  const D x = along(surface.across);
  const D y = along(surface.up);
  const D z = along(surface.ahead);
  switch (surface.shape) {
    case OverlayShape::bent: {
      // The latitude is limited, since Mercator's diverges at the poles; nothing is drawn there.
      const D latitude = {minimum(maximum(y.value, T(-0.9999F)), T(0.9999F)), y.along_x, y.along_y};
      s = detail::arc_tangent_of(x, z) * T(surface.scale / surface.width) + T(0.5F);
      t = T(0.5F) - (detail::area_tangent_of(latitude) - T(surface.middle)) * T(surface.scale / surface.height);
      break;
    }
    case OverlayShape::flat: {
      // Keeps the divisor positive for directions to the side and behind, which are outside the
      // surface's bound.
      const D ahead = {maximum(z.value, T(1e-3F)), z.along_x, z.along_y};
      s = x / ahead * T(1.0F / surface.width) + T(0.5F);
      t = T(0.5F) - y / ahead * T(1.0F / surface.height);
      break;
    }
    case OverlayShape::fisheye: {
      const D square = x * x + z * z;
      const auto near_zenith = (square.value < T(1e-6F)) & (y.value > T(0.0F));
      // Near the zenith the angle equals its sine; the minimum avoids 0 / 0 in the other form.
      const D across = sqrt(D(maximum(square.value, T(1e-12F)), square.along_x, square.along_y));
      const D outwards = select(near_zenith, D(T(1.0F)), detail::arc_tangent_of(across, y) / across);
      const D radius = outwards * T(0.5F / surface.scale);
      s = radius * x + T(0.5F);
      t = radius * z + T(0.5F);
      break;
    }
  }
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
