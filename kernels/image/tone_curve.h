#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/core/host_device.h"

namespace ergodome {

//! How light becomes what a display shows.
enum class ToneCurve : std::int32_t { shoulder, reinhard, filmic, gamma };

//! How a picture's light becomes what a display shows.
struct Tone {
  ToneCurve curve = ToneCurve::shoulder;
  float gain = 1.0F;  //!< exposure, as a factor
  float white = 4.0F;
  float gamma = 2.2F;
};

//! What `shoulder` keeps as it is [display light].
inline constexpr float tone_knee = 0.8F;
//! Display light that light_for_display is made for at the most: `shoulder` comes nearer and nearer to 1, and never there. The 255th byte begins
//! below it.
inline constexpr float brightest_display_light = 0.999F;

inline namespace ERGO_TARGET {

//! Linear display light, mostly in [0, 1], of a channel's light. The presenter's shader says the same.
//!
//! `shoulder` keeps light up to 0.8 as it is and bends what is above towards 1: dome projectors are dark, and skies there should be
//! as dark as they are. `reinhard`: Reinhard et al. (SIGGRAPH 2002), eq. 4. `filmic`: Narkowicz's fit (2015) of the ACES reference
//! curve. `gamma`: a power that lifts what is dark, by which Verbraeck & Eisemann set the number of stars to be seen.
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

//! The light that `toned` makes a display's light of: its inverse, for 0 to brightest_display_light; what is beyond is taken as that.
ERGO_HD float light_for_display(const Tone& tone, float display) {
  const float d = ::fminf(::fmaxf(display, 0.0F), brightest_display_light);
  float x = d;
  switch (tone.curve) {
    case ToneCurve::reinhard: {
      // x² / w² + (1 - d) x - d = 0, in the form that has no difference of near numbers.
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
