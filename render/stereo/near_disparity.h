#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/lens/spread_point.h"
#include "render/passes/objects/polygons/object_outline.h"
#include "render/stereo/disparity_meter.h"
#include "render/stereo/near_sights.h"

// Disparities of disk, shells and objects.

namespace ergodome {

//! Calls visit(view) for the directions, in the view's axes, of a lattice of 9 x 9 points across a
//! picture; omits points that the image does not cover.
template <class Visit>
void visit_lattice(const Projection& projection, Visit&& visit) {
  constexpr int lattice = 9;
  for (int row = 0; row < lattice; ++row) {
    for (int column = 0; column < lattice; ++column) {
      const double x = (column + 0.5) / lattice * projection.width_px;
      const double y = (row + 0.5) / lattice * projection.height_px;
      if (image_coverage(projection, x, y) > 0.0) {
        visit(direction_from_pixel(projection, x, y));
      }
    }
  }
}

//! Calls visit(view) like visit_lattice() for 800 points, spread evenly without symmetries.
template <class Visit>
void visit_many(const Projection& projection, Visit&& visit) {
  constexpr std::size_t many = 800;
  for (std::size_t i = 0; i < many; ++i) {
    const SquarePoint at = spread_point(i);
    const double x = at.x * projection.width_px;
    const double y = at.y * projection.height_px;
    if (image_coverage(projection, x, y) > 0.0) {
      visit(direction_from_pixel(projection, x, y));
    }
  }
}

//! Selects whose disparities are measured in a direction: the sky's, or those of disk and shells.
//! The sky needs many directions, because it is stretched without bound beside its caustics. Disk
//! and shells are found in all directions, because they hide the sky.
enum class DisparityOf : std::uint8_t { sky, disk_and_shells };

//! One of the sampled directions of an image, in the view's axes, and the points of disk and shells
//! that the head sees in it.
struct SeenDirection {
  Vector3<double> view;
  DisparityOf disparity_of;
  std::vector<NearSight> sights;  //!< points from near_sights(), without those that objects hide
  bool ends_at_object = false;

  [[nodiscard]] bool shows_sky() const { return !ends_at_object && (sights.empty() || !sights.back().opaque); }
};

//! Returns whether a show's sky has neither a visible map nor stars.
bool is_black(const SkySettings& sky);

//! Returns the directions in which a frame's disparities are measured. For a black sky there are
//! only those of disk and shells. `hiding`: objects that hide what is behind them.
std::vector<SeenDirection> seen_directions(const Show& show, const CameraPose& pose, const Projection& projection,
                                           const PlacedMeshes& hiding);

//! Adds the disparities of disk, shells and objects where the picture shows them. Of disk and
//! shells, uses the points in some directions, up to the first opaque one. Of each of the sixteen
//! nearest objects, uses the nearest, the farthest and the outermost points, also if something
//! hides them.
//!
//! Light must reach both eyes on the short way round the hole, and eye and point must be more than
//! 2 M from the hole's center. In the model `flat`, things are seen where flat space around the
//! head has them; disk and shells then count at any position, also by light on the long way round.
void add_near_things(const Show& show, const CameraPose& pose, std::span<const SeenDirection> directions,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter);

}  // namespace ergodome
