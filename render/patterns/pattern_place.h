#pragma once

#include <functional>

#include "kernels/projection/pixel_measure.h"
#include "kernels/projection/projection.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! A picture that a pattern is drawn for. Where a dome's projectors show it turned about the dome's own axis, what is level in a leaning dome is not what
//! is level in the picture: places are then asked for where they come to be, and azimuths counted from where the picture's front does.
struct PatternView : Projection {
  //! `turn`: how far the picture is shown turned to the right [rad].
  PatternView(const Projection& projection, double turn = 0.0);

  double turn_sine;
  double turn_cosine;
};

//! What a pattern knows of the place that it is asked the light of.
struct PatternPlace {
  double x_px;
  double y_px;
  Vector3<double> direction;  //!< of the view: x right, y up, z back
  double azimuth_deg;         //!< to the right of the front
  double elevation_deg;
  //! The picture as a sheet that ramps and bars are drawn on, both 0 to 1. A screen is its own sheet; elsewhere `across` is azimuth, from the
  //! back by the left, the front (0.5) and the right, and `up` goes from the horizon (0) to the zenith, and below 0 to the nadir.
  double across;
  double up;
};

//! The place of the picture at pixel coordinates.
PatternPlace pattern_place(const PatternView& projection, double x_px, double y_px);

//! A direction of the sheet, as azimuth and elevation [deg] on the dome: the inverse, above the horizon.
void dome_place(const PatternView& projection, double across, double up, double& azimuth_deg, double& elevation_deg);

//! How many degrees `part` of the sheet's height are, in the middle of it.
double sheet_degrees(const Projection& projection, double part);

//! Light of a place, linear.
using PatternLight = std::function<Vector3<float>(const PatternPlace&)>;

//! A picture of what `light` says: `samples` x `samples` places a pixel, their mean times the pixel's coverage; black where the projection has
//! no image. Such a picture is shown as it is, without a curve: 1 is all that the display has.
Picture draw_pattern(const PatternView& projection, int samples, const PatternLight& light);

//! How much of a pixel lines cover that are `width_px` wide, at every `spacing` of a coordinate that changes by `per_px` a pixel.
double line_at(double coordinate, double spacing, double per_px, double width_px);

//! How fast elevation and azimuth change a pixel [deg], whichever way that is.
struct DomeSteps {
  double elevation_deg;
  double azimuth_deg;
};

DomeSteps dome_steps(const PatternView& projection, const PatternPlace& place);

//! Linear light of a display's value, 0 to 255 (sRGB).
float light_of_value(double value);

}  // namespace ergodome
