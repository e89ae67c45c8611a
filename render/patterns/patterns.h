#pragma once

#include "render/patterns/pattern_place.h"

// The patterns of test_pattern.h, one function each.
namespace ergodome {

Picture polar_grid_pattern(const Projection& projection);
Picture checker_pattern(const Projection& projection);
Picture grey_ramp_pattern(const Projection& projection);
Picture colour_bar_pattern(const Projection& projection);
Picture resolution_pattern(const Projection& projection);
Picture blend_check_pattern(const Projection& projection);
//! `left`, `right`: whether that eye's words are in the picture.
Picture left_right_pattern(const Projection& projection, bool left, bool right);
//! Every pixel of the same grey, linear.
Picture even_pattern(const Projection& projection, float light);

}  // namespace ergodome
