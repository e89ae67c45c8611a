#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Display-referred sRGB, three bytes a pixel, of a picture.
//!
//! Light up to 0.8 is kept as it is; above, a smooth shoulder approaches 1, so that bright places keep their colour's shape. Heat
//! maps are already colours and are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

}  // namespace ergodome
