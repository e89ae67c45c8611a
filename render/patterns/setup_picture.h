#pragma once

#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Part of the domemaster's circle that each projector lights, 0 to 1, and that none does, last.
std::vector<double> lit_parts(const std::vector<ProjectorPicture>& pictures);

//! A drawing of what lights the dome, as a domemaster: each projector has a colour, which is the brighter the more of the light there is its own;
//! lines are 16 of its raster's columns and rows, its number stands in its middle. What no projector lights is black with a grid.
Picture draw_setup(const std::vector<ProjectorPicture>& pictures, int size_px);

}  // namespace ergodome
