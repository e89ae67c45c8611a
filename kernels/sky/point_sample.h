#pragma once

#include "kernels/sky/elliptic_filter.h"

namespace ergodome::inline ERGO_TARGET {

//! Returns the light of the sky in one direction per pixel, times a factor: bilinear between the
//! finest texels, regardless of the pixel's footprint. Fine stars and lines flicker where the lens
//! shrinks the sky.
//!
//! `direction` is a unit vector; a zero vector sees the mean of the sky.
template <class T>
ERGO_HD SkyLight<T> sample_sky(const CubeMap& map, const Vector3<T>& direction, const T& factor) {
  const T zero(0.0F);
  const auto known = dot(direction, direction) > T(0.5F);
  SkyLight<T> light = detail::no_light<T>();
  const T seen = select(known, factor, zero);
  if (any(seen > zero)) {
    const Vector3<T> towards = {select(known, direction.x, T(1.0F)), direction.y, direction.z};
    detail::add_probe(detail::level_lanes<T>(map, truncated(zero)), cube_place(towards), seen, light);
  }
  detail::add_mean(map, select(known, zero, factor), light);
  return light;
}

}  // namespace ergodome::inline ERGO_TARGET
