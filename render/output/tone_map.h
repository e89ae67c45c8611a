#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Display-referred sRGB, three bytes a pixel, of a picture.
//!
//! By the picture's tone; heat maps are already colours and are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

//! The same with 16 bits a channel.
std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture);

//! The picture's coverage, 0 to 1, one number a pixel.
std::vector<float> coverage_of(const Picture& picture);

}  // namespace ergodome
