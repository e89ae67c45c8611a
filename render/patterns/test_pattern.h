#pragma once

#include <string>
#include <vector>

#include "render/patterns/pattern_position.h"
#include "render/picture/picture.h"

// Pictures for setting up domes, projectors and stereo displays. All are in linear light that is
// shown without a tone curve: the display gets the values on a pattern's labels.
namespace ergodome {

enum class TestPattern {
  orientation,  //!< which side is which (orientation_pattern)
  //! Circles and meridians every 5°, numbers every 10°, compass directions (north in front).
  polar_grid,
  checker,      //!< fields of 10° in elevation and about the same width
  grey_ramp,    //!< steps of 16 values, a smooth ramp, the darkest and the brightest 17 values
  colour_bars,  //!< eight bars of 75 % and of 100 %, repeated four times around the dome
  resolution,   //!< Siemens stars, and lines one and two pixels wide, over the whole picture
  //! Uniform gray with lines every 10°: seams appear as bands, misalignment as double lines.
  blend_check,
  left_right,  //!< texts that name the eye that should see them
  white,       //!< maximum light of the display
  black        //!< no light
};

//! Returns the command-line names of the patterns in the order of TestPattern.
const std::vector<std::string>& test_pattern_names();

//! Returns the pattern of a name. Throws Error for an unknown name, listing the known ones.
TestPattern test_pattern(const std::string& name);

//! Draws a pattern for an eye; only `left_right` differs between eyes.
Picture draw_test_pattern(TestPattern pattern, const PatternView& projection, FramePart eye = FramePart::whole);

//! Draws a projector's own raster, without warp: its number and name, its size, a frame of single
//! pixels at the edge, both diagonals, and a circle that is round if pixels are square. `number`
//! counts from 1. Throws Error unless both sides are 1 to 16,384 px.
Picture draw_projector_number(int number, const std::string& name, int width_px, int height_px);

}  // namespace ergodome
