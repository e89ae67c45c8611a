#pragma once

#include <algorithm>

#include "content/timeline/timeline.h"
#include "kernels/overlay/overlay_surface.h"
#include "kernels/projection/projection.h"

namespace ergodome {

//! Returns the opacity of an overlay at a show time, 0 to 1. During fading, it follows 3x² - 2x³,
//! where x is the fraction of the fade's duration.
inline double presence_at(const Presence& presence, double time_s) {
  if (!(time_s >= presence.from_s && time_s < presence.to_s)) {
    return 0.0;
  }
  const auto part = [](double elapsed_s, double fade_s) {
    const double x = fade_s > 0.0 ? std::min(elapsed_s / fade_s, 1.0) : 1.0;
    return x * x * (3.0 - 2.0 * x);
  };
  return part(time_s - presence.from_s, presence.fade_in_s) * part(presence.to_s - time_s, presence.fade_out_s);
}

//! Returns the projection in which overlays are drawn. Overlays are fixed to the dome or screen:
//! the result for a dome has neither tilt nor viewer position, so that overlays do not move with
//! these.
//!
//! `projection`: that of the head. `offset`: distance of the eye to the right of the head [M].
//! `convergence`: convergence distance of the stereo [M], 0 for infinity. `distance`: apparent
//! depth of the overlay in the picture [M]; 0: on the dome or screen, at the same position for both
//! eyes; std::numeric_limits::infinity(): behind everything.
Projection overlay_projection(const Projection& projection, double offset = 0.0, double convergence = 0.0,
                              double distance = 0.0);

//! Position and size of an overlay in a picture.
struct PlacedOverlay {
  DomePosition position;
  double scale = 1.0;  //!< factor on the overlay's size
  bool shown = true;
};

//! Returns where an overlay appears in a picture; `width` and `height` are its size [rad]. On
//! domes, cylinders, cubes and full spheres, it appears at its own position. A flat screen shows
//! only a part of the dome: overlays that extend beyond the screen are moved inside, and shrunk if
//! they are larger than the screen. Overlays with an azimuth of more than 60° from the front are
//! omitted on a flat screen.
PlacedOverlay placed_overlay(const Projection& projection, const DomePosition& position, double width, double height);

//! Returns the surface on which a caption of a given size [rad], measured along its middle, is
//! drawn. It is bent along the circle of its elevation up to 60°; above, the bend decreases to zero
//! at the zenith.
OverlaySurface bent_surface(const DomePosition& position, double width, double height);

//! Returns the maximum width of a caption's surface from bent_surface() [rad], slightly less than a
//! full circle.
double widest_bent_surface(const DomePosition& position);

//! Returns the plane surface on which an image is drawn. `width`: angle of the image, below π
//! [rad]. `aspect`: width over height.
OverlaySurface flat_surface(const DomePosition& position, double width, double aspect);

//! Returns the surface on which a domemaster overlay is drawn. `field_of_view`: full angle [rad].
OverlaySurface fisheye_surface(double field_of_view);

//! Sets OverlaySurface::bound_axis and bound_cosine: a cone that contains the overlay with a margin
//! of `margin` [rad].
void bound_surface(OverlaySurface& surface, double margin);

//! Returns the direction of a point of a bent or flat overlay. (s, t) run from 0 to 1, from the
//! left and from the top.
Vector3<double> direction_on_surface(const OverlaySurface& surface, double s, double t);

}  // namespace ergodome
