#pragma once

#include <algorithm>

#include "content/timeline/timeline.h"
#include "kernels/overlay/overlay_sheet.h"
#include "kernels/projection/projection.h"

namespace ergodome {

//! How much of an overlay is there at a time of the show, 0 to 1: it comes and goes smoothly (3x² - 2x³) within its time.
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

//! The projection by which pictures are drawn on that stand on the dome or screen itself: of a dome without its tilt and its viewer, so that nothing
//! moves them.
//!
//! `projection`: the head's. `offset`: of the eye from the head, to the right [M]. `convergence`: of the stereo [M], 0 for infinity. `distance`: where
//! in the depth of the picture the overlay appears [M]: 0 on the dome or screen, where both eyes have it in one place; std::numeric_limits::infinity()
//! behind all.
Projection overlay_projection(const Projection& projection, double offset = 0.0, double convergence = 0.0,
                              double distance = 0.0);

//! An overlay's place and size in a picture.
struct PlacedOverlay {
  DomePlace place;
  double scale = 1.0;  //!< on its size
  bool shown = true;
};

//! Where an overlay of a size [rad] goes in a picture. On domes, cylinders, cubes and whole spheres that is its place. A flat screen shows a part of
//! the dome: what would stick out of it is moved in and, if it is larger than the screen, made smaller; what is more than 60° beside the front is
//! left out.
PlacedOverlay placed_overlay(const Projection& projection, const DomePlace& place, double width, double height);

//! A caption's sheet, of a size along its middle [rad]. It bends along the circle of its elevation up to 60°; above, less and less, and at the zenith it
//! is straight.
OverlaySheet bent_sheet(const DomePlace& place, double width, double height);

//! The widest that a bent sheet can be [rad]: somewhat less than once round.
double widest_bent_sheet(const DomePlace& place);

//! An image's sheet on a plane; `width`: angle that it spans [rad], below π. `aspect`: width over height.
OverlaySheet flat_sheet(const DomePlace& place, double width, double aspect);

//! A domemaster's sheet; its full field of view [rad].
OverlaySheet fisheye_sheet(double field_of_view);

//! Sets the sheet's bound: a cone that holds all of it, and `margin` [rad] around it.
void bound_sheet(OverlaySheet& sheet, double margin);

//! Direction of a place of a bent or flat sheet (s, t: 0 to 1 from the left and the top).
Vector3<double> direction_on_sheet(const OverlaySheet& sheet, double s, double t);

}  // namespace ergodome
