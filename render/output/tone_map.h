#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Display-referred sRGB, three bytes a pixel, of a picture.
//!
//! By the picture's tone; heat maps are already colours and are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

}  // namespace ergodome
