#pragma once

#include <cstdint>
#include <vector>

#include "render/picture/picture.h"

namespace ergodome {

//! Returns a picture as display-referred sRGB, three bytes per pixel.
//!
//! Applies the picture's tone; heat maps are colors already and are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

//! Returns the same with 16 bits per channel.
std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture);

//! Returns the picture's coverage, 0 to 1, one value per pixel.
std::vector<float> coverage_of(const Picture& picture);

}  // namespace ergodome
