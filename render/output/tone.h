#pragma once

#include <algorithm>
#include <cmath>

#include "content/show.h"

namespace ergodome {

//! How a picture's light becomes what a display shows.
struct Tone {
  ToneCurve curve = ToneCurve::shoulder;
  float gain = 1.0F;  //!< exposure, as a factor
  float white = 4.0F;
  float gamma = 2.2F;
};

//! The tone that settings ask for, without what exposure follows by itself.
inline Tone tone_of(const ToneSettings& settings) {
  return {settings.curve, std::exp2(static_cast<float>(settings.exposure_stops)), static_cast<float>(settings.white),
          static_cast<float>(settings.gamma)};
}

//! Linear display light, mostly in [0, 1], of a channel's light. The presenter's shader says the same.
//!
//! `shoulder` keeps light up to 0.8 as it is and bends what is above towards 1: dome projectors are dark, and skies there should be
//! as dark as they are. `reinhard`: Reinhard et al. (SIGGRAPH 2002), eq. 4. `filmic`: Narkowicz's fit (2015) of the ACES reference
//! curve. `gamma`: a power that lifts what is dark, by which Verbraeck & Eisemann set the number of stars to be seen.
inline float toned(const Tone& tone, float light) {
  const float x = std::max(tone.gain * light, 0.0F);
  switch (tone.curve) {
    case ToneCurve::reinhard:
      return x < 1e18F ? x * (1.0F + x / (tone.white * tone.white)) / (1.0F + x) : 1.0F;
    case ToneCurve::filmic:
      return x < 1e4F ? x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F) : 1.0F;
    case ToneCurve::gamma:
      return std::pow(x, 1.0F / tone.gamma);
    case ToneCurve::shoulder:
      break;
  }
  constexpr float knee = 0.8F;
  return x <= knee ? x : 1.0F - (1.0F - knee) * std::exp(-(x - knee) / (1.0F - knee));
}

}  // namespace ergodome
