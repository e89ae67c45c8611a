#pragma once

#include <string>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! A word of the orientation pattern. It reads upright for a viewer inside who faces it.
struct PatternLabel {
  std::string text;
  double azimuth_deg;    //!< to the right of the front
  double elevation_deg;  //!< upwards; at 90 and -90 its top points away from its azimuth, and towards it
  double height_deg;     //!< of the letters
  Vector3<float> colour;
};

//! FRONT (yellow), RIGHT (green), BACK (blue) and LEFT (red) just above the horizon, ZENITH and NADIR (white), and numbers of degrees (grey).
std::vector<PatternLabel> pattern_labels();

//! A picture that settles arguments about left and right: circles of elevation and lines of azimuth every 15° as a viewer inside has them,
//! the horizon and the four quarters brighter, labelled. Linear light, coverage in the fourth channel; black where the projection has no
//! image.
Picture orientation_pattern(const Projection& projection);

}  // namespace ergodome
