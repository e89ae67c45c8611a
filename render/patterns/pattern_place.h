#pragma once

#include <functional>

#include "kernels/projection/pixel_measure.h"
#include "kernels/projection/projection.h"
#include "render/picture/picture.h"

// The framework in which all patterns are drawn.

namespace ergodome {

//! The projection for which a pattern is drawn. Projectors may show the picture turned about the
//! dome's axis; on a tilted dome, horizontal on the dome then differs from horizontal in the
//! picture. Positions are therefore those where pixels are shown, and azimuths count from where the
//! picture's front is shown.
struct PatternView : Projection {
  //! `turn`: rotation of the shown picture to the right [rad].
  PatternView(const Projection& projection, double turn = 0.0);

  double turn_sine;
  double turn_cosine;
};

//! A position for which a pattern computes the light.
struct PatternPlace {
  double x_px;
  double y_px;
  Vector3<double> direction;  //!< in the view: x right, y up, z back
  double azimuth_deg;         //!< to the right of the front
  double elevation_deg;
  //! Position on the sheet on which ramps and bars are drawn. A screen is its own sheet, 0 to 1 both
  //! ways. Otherwise `across` is the azimuth, from the back (0) over the left, the front (0.5) and the
  //! right, and `up` runs from the nadir (-1) over the horizon (0) to the zenith (1).
  double across;
  double up;
};

//! Returns the position of a pattern at pixel coordinates.
PatternPlace pattern_place(const PatternView& projection, double x_px, double y_px);

//! Converts a position on the sheet, above the horizon, to azimuth and elevation on the dome [deg].
void dome_place(const PatternView& projection, double across, double up, double& azimuth_deg, double& elevation_deg);

//! Returns the degrees that correspond to `part` of the sheet's height, in its middle.
double sheet_degrees(const Projection& projection, double part);

//! Returns the linear light at a position.
using PatternLight = std::function<Vector3<float>(const PatternPlace&)>;

//! Draws the picture of a pattern: the mean of `samples` x `samples` positions per pixel, times the
//! pixel's coverage; black where the projection has no image. Such a picture is shown without a
//! tone curve: 1 is the display's maximum.
Picture draw_pattern(const PatternView& projection, int samples, const PatternLight& light);

//! Returns how much of a pixel is covered by lines `width_px` wide, at every `spacing` of a
//! coordinate that changes by `per_px` per pixel.
double line_at(double coordinate, double spacing, double per_px, double width_px);

//! Changes of elevation and azimuth per pixel [deg], in any direction.
struct DomeSteps {
  double elevation_deg;
  double azimuth_deg;
};

DomeSteps dome_steps(const PatternView& projection, const PatternPlace& place);

//! Converts a display value, 0 to 255 (sRGB), to linear light.
float light_of_value(double value);

}  // namespace ergodome
