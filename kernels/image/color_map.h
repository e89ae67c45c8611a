#pragma once

#include <cmath>

#include "kernels/core/host_device.h"
#include "kernels/core/vector3.h"

// Color maps of heat maps, and the transfer curve of sRGB.
namespace ergodome::inline ERGO_TARGET {

//! Returns a perceptual color for a value in [0, 1], from dark blue over teal and green to yellow:
//! piecewise linear in display values between nine stops whose CIE lightness rises evenly. The
//! result is display-referred sRGB, 0 to 1. Values outside are clamped; NaN is magenta.
ERGO_HD Vector3<float> heat_color(float value) {
  constexpr float stops[9][3] = {{0.07F, 0.03F, 0.20F}, {0.16F, 0.14F, 0.42F}, {0.15F, 0.29F, 0.55F},
                                 {0.12F, 0.43F, 0.56F}, {0.11F, 0.56F, 0.52F}, {0.25F, 0.69F, 0.42F},
                                 {0.53F, 0.79F, 0.27F}, {0.83F, 0.86F, 0.20F}, {0.99F, 0.96F, 0.60F}};
  if (!(value == value)) {
    return {1.0F, 0.0F, 1.0F};
  }
  const float position = 8.0F * ::fminf(::fmaxf(value, 0.0F), 1.0F);
  const int below = position < 7.0F ? static_cast<int>(position) : 7;
  const float part = position - static_cast<float>(below);
  const float* low = stops[below];
  const float* high = stops[below + 1];
  return {low[0] + part * (high[0] - low[0]), low[1] + part * (high[1] - low[1]), low[2] + part * (high[2] - low[2])};
}

//! Returns the color for a position within a heat map's range of frequency ratios: red at 0
//! (redshift), white at 0.5, blue at 1. Display-referred sRGB, 0 to 1. Values outside are clamped.
//! NaN is magenta.
ERGO_HD Vector3<float> shift_color(float value) {
  if (!(value == value)) {
    return {1.0F, 0.0F, 1.0F};
  }
  const float signed_value = 2.0F * ::fminf(::fmaxf(value, 0.0F), 1.0F) - 1.0F;
  const float fade = ::fabsf(signed_value);
  const Vector3<float> end =
      signed_value < 0.0F ? Vector3<float>{0.70F, 0.05F, 0.10F} : Vector3<float>{0.08F, 0.25F, 0.75F};
  const Vector3<float> white = {0.95F, 0.95F, 0.93F};
  return white + fade * (end - white);
}

//! Applies the transfer curve of sRGB (IEC 61966-2-1), for values 0 to 1.
ERGO_HD float srgb_encoded(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * ::powf(linear, 1.0F / 2.4F) - 0.055F;
}

ERGO_HD float srgb_decoded(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : ::powf((encoded + 0.055F) / 1.055F, 2.4F);
}

}  // namespace ergodome::inline ERGO_TARGET
