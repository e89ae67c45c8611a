#pragma once

#include <vector>

#include "render/patterns/dome_label.h"
#include "render/patterns/pattern_place.h"

// The test pattern for orientation.

namespace ergodome {

//! Returns the labels FRONT (yellow), RIGHT (green), BACK (blue) and LEFT (red) just above the
//! horizon, ZENITH and NADIR (white), and degrees (gray).
std::vector<DomeLabel> orientation_labels();

//! Draws circles of elevation and lines of azimuth every 15° as a viewer inside sees them, with
//! brighter horizon and quarters, and labels. Shows whether left and right are correct. Linear
//! light, coverage in the fourth channel; black where the projection has no image.
Picture orientation_pattern(const PatternView& projection);

}  // namespace ergodome
