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
//! `left`, `right`: whether that eye's words are in the picture.
Picture left_right_pattern(const PatternView& projection, bool left, bool right);
//! Every pixel of the same grey, linear.
Picture even_pattern(const PatternView& projection, float light);

}  // namespace ergodome
