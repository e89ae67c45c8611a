#pragma once

#include <cmath>

#include "content/show/show.h"
#include "kernels/image/tone_curve.h"

namespace ergodome {

//! Returns the tone of settings, without automatic exposure.
inline Tone tone_of(const ToneSettings& settings) {
  return {settings.curve, std::exp2(static_cast<float>(settings.exposure_stops)), static_cast<float>(settings.white),
          static_cast<float>(settings.gamma)};
}

}  // namespace ergodome
