#pragma once

#include "render/patterns/pattern_place.h"

// The patterns of test_pattern.h, one function each.
namespace ergodome {

Picture polar_grid_pattern(const PatternView& projection);
Picture checker_pattern(const PatternView& projection);
Picture grey_ramp_pattern(const PatternView& projection);
Picture colour_bar_pattern(const PatternView& projection);
Picture resolution_pattern(const PatternView& projection);
Picture blend_check_pattern(const PatternView& projection);
//! Draws the pattern with the texts of the left eye, the right eye or both.
Picture left_right_pattern(const PatternView& projection, bool left, bool right);
//! Draws a uniform gray, in linear light.
Picture even_pattern(const PatternView& projection, float light);

}  // namespace ergodome
