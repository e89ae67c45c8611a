#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/core/host_device.h"

// Tone curves, and their inverses.
namespace ergodome {

//! Tone curves, from a picture's light to display light.
enum class ToneCurve : std::int32_t { shoulder, reinhard, filmic, gamma };

//! The conversion of a picture's light to display light.
struct Tone {
  ToneCurve curve = ToneCurve::shoulder;
  float gain = 1.0F;  //!< factor of the light (exposure)
  float white = 4.0F;
  float gamma = 2.2F;
};

//! Light up to which `shoulder` is linear [display light].
inline constexpr float tone_knee = 0.8F;
//! Maximum display light that light_for_display() inverts: `shoulder` approaches 1 but never
//! reaches it. The byte 255 starts below this value.
inline constexpr float brightest_display_light = 0.999F;

inline namespace ERGO_TARGET {

//! Returns the linear display light of a channel's light: 0 to 1 for `shoulder`; the other curves
//! may exceed 1 for bright light. The shader of the player implements the same.
//!
//! `shoulder` keeps light up to 0.8 and compresses what is above towards 1: dome projectors are
//! dark, and dark skies must remain dark. `reinhard`: Reinhard et al. (SIGGRAPH 2002), eq. 4.
//! `filmic`: Narkowicz's fit (2015) of the ACES reference curve. `gamma`: a power that brightens
//! dark parts, with which Verbraeck & Eisemann control the number of visible stars.
ERGO_HD float toned(const Tone& tone, float light) {
  const float x = ::fmaxf(tone.gain * light, 0.0F);
  switch (tone.curve) {
    case ToneCurve::reinhard:
      return x < 1e18F ? x * (1.0F + x / (tone.white * tone.white)) / (1.0F + x) : 1.0F;
    case ToneCurve::filmic:
      return x < 1e4F ? x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F) : 1.0F;
    case ToneCurve::gamma:
      return ::powf(x, 1.0F / tone.gamma);
    case ToneCurve::shoulder:
      break;
  }
  return x <= tone_knee ? x : 1.0F - (1.0F - tone_knee) * ::expf(-(x - tone_knee) / (1.0F - tone_knee));
}

//! Returns the light that toned() converts to the given display light: its inverse, for 0 to
//! brightest_display_light; larger values are clamped.
ERGO_HD float light_for_display(const Tone& tone, float display) {
  const float d = ::fminf(::fmaxf(display, 0.0F), brightest_display_light);
  float x = d;
  switch (tone.curve) {
    case ToneCurve::reinhard: {
      // Solves x² / w² + (1 - d) x - d = 0 for x, in the form without cancellation.
      const float rest = 1.0F - d;
      x = 2.0F * d / (rest + ::sqrtf(rest * rest + 4.0F * d / (tone.white * tone.white)));
      break;
    }
    case ToneCurve::filmic: {
      const float a = 2.51F - 2.43F * d;
      const float half = 0.5F * (0.59F * d - 0.03F);
      const float root = ::sqrtf(half * half + 0.14F * a * d);
      x = half > 0.0F ? (half + root) / a : 0.14F * d / (root - half);
      break;
    }
    case ToneCurve::gamma:
      x = ::powf(d, tone.gamma);
      break;
    case ToneCurve::shoulder:
      x = d <= tone_knee ? d : tone_knee - (1.0F - tone_knee) * ::logf((1.0F - d) / (1.0F - tone_knee));
      break;
  }
  return x / tone.gain;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
