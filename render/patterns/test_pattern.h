#pragma once

#include <string>
#include <vector>

#include "render/frame/show_renderer.h"
#include "render/patterns/pattern_place.h"

// Pictures by which domes, projectors and stereo displays are set up. All are linear light that is shown without a curve: a pattern's
// values arrive at the display as its labels say.
namespace ergodome {

enum class TestPattern {
  orientation,  //!< which side is which (orientation_pattern.h)
  polar_grid,   //!< circles and meridians every 5°, numbers every 30°, the compass (north in front)
  checker,      //!< fields of 10° in elevation, and of about as much across
  grey_ramp,    //!< steps of 16 values, a smooth ramp, the darkest and the brightest 17 values
  colour_bars,  //!< eight bars of 75 % and of 100 %, four times round
  resolution,   //!< stars of wedges, and lines one and two pixels wide, over the picture
  blend_check,  //!< an even grey with lines every 10°: seams show as bands, misfits as double lines
  left_right,   //!< what each eye should see is written to it
  white,        //!< all of the display's light
  black         //!< none of it
};

//! Names of the patterns in the order of TestPattern, as the command line has them.
const std::vector<std::string>& test_pattern_names();

//! The pattern of a name; throws Error for another, with those that there are.
TestPattern test_pattern(const std::string& name);

//! A pattern as an eye sees it; but for `left_right` all eyes, and the whole, see the same.
Picture draw_test_pattern(TestPattern pattern, const PatternView& projection, FramePart eye = FramePart::whole);

//! A projector's own raster, without warp: its number and name, its size, a frame of single pixels along its very edge, both diagonals and
//! a circle that a square pixel leaves round. `number` counts from 1.
Picture draw_projector_number(int number, const std::string& name, int width_px, int height_px);

}  // namespace ergodome
