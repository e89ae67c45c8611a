#pragma once

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Scatters light in place: (1 - strength) * picture + strength * blurred; coverage stays.
//!
//! The total light is that of before: what would leave the picture comes back in, as from surroundings that mirror it (where a size does
//! not halve evenly, light beside that border may gain or lose). A uniform picture stays as it is. Values that are not finite scatter
//! nothing and remain where they are. Works for any size; memory: a third to a half of the picture's.
//!
//! Method: a chain of halved pictures and the equal sum of its levels (Jimenez, "Next generation post processing in Call of Duty:
//! Advanced Warfare", SIGGRAPH 2014): some tens of nanoseconds a pixel, whatever the radius.
void add_bloom(Picture& picture, const BloomSettings& settings);

}  // namespace ergodome
