#pragma once

#include <vector>

// The dark rim around letters.

namespace ergodome {

//! Returns the reach of the dark rim around letters [px] for a line height [px]: at least 2.
int text_rim_reach_px(int line_px);

//! Returns the darkness of the rim around letters at each pixel, 0 to 1: dark beside the letters,
//! fading outwards. `coverage`: of the letters, row by row; the image must have a margin of
//! `reach_px` around them.
std::vector<float> text_rim(const std::vector<float>& coverage, int width, int height, int reach_px);

}  // namespace ergodome
