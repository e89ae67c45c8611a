#pragma once

#include <functional>

#include "kernels/projection/pixel_measure.h"
#include "kernels/projection/projection.h"
#include "render/picture/picture.h"

// Functions with which all patterns are drawn.

namespace ergodome {

//! The projection for which a pattern is drawn, and the rotation with which projectors show the
//! picture. Projectors may turn the picture around the dome's axis; on a tilted dome, horizontal
//! lines of the dome are then not horizontal in the picture. Patterns use the position on the dome
//! at which a pixel is shown, and count azimuths from the point where the front of the picture is
//! shown.
struct PatternView : Projection {
  //! `turn`: angle by which the shown picture is rotated to the right [rad].
  PatternView(const Projection& projection, double turn = 0.0);

  double turn_sine;
  double turn_cosine;
};

//! A position of a picture for which a pattern computes the light.
struct PatternPosition {
  double x_px;
  double y_px;
  Vector3<double> direction;  //!< direction in the view: x right, y up, z back
  double azimuth_deg;         //!< azimuth to the right of the front
  double elevation_deg;
  //! Coordinates in which ramps and bars are drawn. On a flat screen, both run from 0 to 1 across
  //! the screen. Otherwise `across` is the azimuth, from the back (0) over the left, the front
  //! (0.5) and the right, and `up` runs from the nadir (-1) over the horizon (0) to the zenith (1).
  double across;
  double up;
};

//! Returns the position for a pattern at pixel coordinates of a picture.
PatternPosition pattern_position(const PatternView& projection, double x_px, double y_px);

//! Converts PatternPosition's coordinates `across` and `up` to azimuth and elevation on the dome
//! [deg].
void dome_position(const PatternView& projection, double across, double up, double& azimuth_deg, double& elevation_deg);

//! Returns the angle [deg] that corresponds to a difference of `part` in PatternPosition::up, in
//! the middle of the picture.
double surface_degrees(const Projection& projection, double part);

//! Function that returns the linear light of a pattern at a position.
using PatternLight = std::function<Vector3<float>(const PatternPosition&)>;

//! Draws a pattern: each pixel is the mean of `samples` x `samples` positions, times the pixel's
//! coverage; black where the projection has no image. The picture is to be shown without a tone
//! curve: 1 is the display's maximum.
Picture draw_pattern(const PatternView& projection, int samples, const PatternLight& light);

//! Returns the fraction of a pixel that is covered by lines of width `width_px`. The lines are at
//! multiples of `spacing` of a coordinate, which changes by `per_px` per pixel.
double line_at(double coordinate, double spacing, double per_px, double width_px);

//! Maximum changes of elevation and azimuth from one pixel to the next, in any direction [deg].
struct DomeSteps {
  double elevation_deg;
  double azimuth_deg;
};

DomeSteps dome_steps(const PatternView& projection, const PatternPosition& position);

//! Converts a display value, 0 to 255 (sRGB), to linear light.
float light_of_value(double value);

}  // namespace ergodome
