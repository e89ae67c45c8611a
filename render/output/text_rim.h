#pragma once

#include <vector>

namespace ergodome {

//! How far the dark rim about letters reaches [px], for lines of a height [px]: at least 2.
int text_rim_reach_px(int line_px);

//! Returns how dark the rim about letters is at each pixel, 0 to 1: dark beside the letters, and soft towards its end. `coverage`: of the letters,
//! row by row; the image must leave them a margin as wide as the rim reaches.
std::vector<float> text_rim(const std::vector<float>& coverage, int width, int height, int reach_px);

}  // namespace ergodome
