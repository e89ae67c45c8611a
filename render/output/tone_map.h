#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/tone_curve.h"
#include "render/picture/picture.h"

namespace ergodome {

//! Returns the tone of settings, without automatic exposure.
inline Tone tone_of(const ToneSettings& settings) {
  return {settings.curve, std::exp2(static_cast<float>(settings.exposure_stops)), static_cast<float>(settings.white),
          static_cast<float>(settings.gamma)};
}

//! Returns a picture as display-referred sRGB, three bytes per pixel.
//!
//! Applies the picture's tone; heat maps are colors already and are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

//! Returns the same with 16 bits per channel.
std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture);

//! Returns the picture's coverage, 0 to 1, one value per pixel.
std::vector<float> coverage_of(const Picture& picture);

}  // namespace ergodome
