#pragma once

#include <vector>

#include "render/patterns/dome_label.h"
#include "render/patterns/pattern_place.h"

namespace ergodome {

//! FRONT (yellow), RIGHT (green), BACK (blue) and LEFT (red) just above the horizon, ZENITH and NADIR (white), and numbers of degrees (grey).
std::vector<DomeLabel> orientation_labels();

//! A picture that settles arguments about left and right: circles of elevation and lines of azimuth every 15° as a viewer inside has them,
//! the horizon and the four quarters brighter, labelled. Linear light, coverage in the fourth channel; black where the projection has no
//! image.
Picture orientation_pattern(const PatternView& projection);

}  // namespace ergodome
