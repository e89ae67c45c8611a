#pragma once

#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/picture/picture.h"

// Draws which projector lights which part of the dome.

namespace ergodome {

//! Returns the fraction of the dome's solid angle that each projector lights, 0 to 1, followed by
//! the fraction that none lights.
std::vector<double> lit_parts(const std::vector<ProjectorPicture>& pictures);

//! Draws how projectors light the dome, as a domemaster. Each projector has a color, which is
//! brighter the larger its share of the light. Lines mark 16 columns and rows of its raster, its
//! number is in the middle. Parts without light are black with a grid.
Picture draw_setup(const std::vector<ProjectorPicture>& pictures, int size_px);

}  // namespace ergodome
