#pragma once

#include "kernels/sky/blackbody.h"

// Frequency shift of colors that resemble blackbodies.
namespace ergodome::inline ERGO_TARGET {

//! Returns the luminance of light in linear sRGB (the middle row of its matrix to tristimulus
//! values, IEC 61966-2-1).
template <class T>
ERGO_HD T luminance_of(const Vector3<T>& rgb) {
  return T(0.2126729F) * rgb.x + T(0.7151522F) * rgb.y + T(0.0721750F) * rgb.z;
}

//! Converts linear sRGB to tristimulus values: the inverse of linear_srgb().
template <class T>
ERGO_HD Vector3<T> tristimulus_of(const Vector3<T>& rgb) {
  return {T(0.4124564F) * rgb.x + T(0.3575761F) * rgb.y + T(0.1804375F) * rgb.z, luminance_of(rgb),
          T(0.0193339F) * rgb.x + T(0.1191920F) * rgb.y + T(0.9503041F) * rgb.z};
}

//! Shifts light in linear sRGB by the frequency ratio g. Its color is close to that of a blackbody
//! of temperature T; each of its tristimulus values changes by the factor of the blackbody's, from
//! T to gT.
//!
//! Intensity over the cube of the frequency is constant along a ray, so a blackbody remains one, of
//! temperature gT. Other light keeps its ratio to the blackbody. Tristimulus values are used
//! instead of red, green and blue because they are positive at every temperature; luminance then
//! changes exactly like the blackbody's.
ERGO_HD Vector3<float> shifted_light(const BlackbodyTable& table, const Vector3<float>& light, float log_temperature,
                                     float g) {
  const Vector3<float> xyz = tristimulus_of(light);
  if (!(xyz.y > 1e-37F)) {
    return {0.0F, 0.0F, 0.0F};
  }
  const Vector3<float> at_rest = read_blackbody(table, log_temperature);
  const Vector3<float> seen = read_blackbody(table, log_temperature + ::logf(maximum(g, 1e-30F)));
  const float luminance = xyz.y * ::expf(minimum(seen.x - at_rest.x, 80.0F));
  const Vector3<float> unit = {xyz.x / xyz.y * (seen.y / at_rest.y), 1.0F, xyz.z / xyz.y * (seen.z / at_rest.z)};
  return displayable(linear_srgb(unit), luminance);
}

}  // namespace ergodome::inline ERGO_TARGET
