#pragma once

#include <vector>

#include "render/patterns/dome_label.h"
#include "render/patterns/pattern_position.h"

// The patterns of test_pattern.h, one function each.

namespace ergodome {

Picture polar_grid_pattern(const PatternView& projection);
Picture checker_pattern(const PatternView& projection);
Picture grey_ramp_pattern(const PatternView& projection);
Picture colour_bar_pattern(const PatternView& projection);
Picture resolution_pattern(const PatternView& projection);
Picture blend_check_pattern(const PatternView& projection);
//! Draws the texts of the left eye, the right eye or both, on a dim polar grid.
Picture left_right_pattern(const PatternView& projection, bool left, bool right);
//! Draws a uniform gray, in linear light.
Picture even_pattern(const PatternView& projection, float light);

//! Returns the labels FRONT (yellow), RIGHT (green), BACK (blue) and LEFT (red) just above the
//! horizon, ZENITH and NADIR (white), and degrees (gray).
std::vector<DomeLabel> orientation_labels();

//! Draws circles of elevation and lines of azimuth every 15° as a viewer inside sees them, with a
//! brighter horizon, brighter lines of azimuth every 90°, and labels. Shows whether left and right
//! are correct. Linear light, coverage in the fourth channel; black where the projection has no
//! image.
Picture orientation_pattern(const PatternView& projection);

}  // namespace ergodome
