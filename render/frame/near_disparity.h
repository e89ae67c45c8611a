#pragma once

#include <span>
#include <vector>

#include "render/frame/disparity_meter.h"
#include "render/frame/near_sights.h"
#include "render/objects/object_outline.h"

namespace ergodome {

//! Calls visit(view) for directions across an image, in the view's axes.
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

//! A direction across an image, in the view's axes, and what of disk and shells the head sees there.
struct SeenDirection {
  Vector3<double> view;
  std::vector<NearSight> sights;  //!< see near_sights; what objects hide is not among them
  bool ends_at_object = false;

  [[nodiscard]] bool shows_sky() const { return !ends_at_object && (sights.empty() || !sights.back().opaque); }
};

//! The directions in which a frame's disparities are looked at. `hiding`: objects that hide what is behind them.
std::vector<SeenDirection> seen_directions(const Show& show, const CameraPose& pose, const Projection& projection,
                                           const PlacedMeshes& hiding);

//! Adds what stands near the hole to the disparities of a frame, where a picture shows it: places of disk and shells in some directions, up to what
//! is opaque, and of the sixteen nearest objects the nearest, the farthest and the outermost places, which nothing hides. Light comes to both eyes the short way
//! round, and neither end is within 2 M of the hole's middle. In the model `flat` things stand where flat space has them; there disk and shells count wherever
//! they are, and the long way round, too.
void add_near_things(const Show& show, const CameraPose& pose, std::span<const SeenDirection> directions,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter);

}  // namespace ergodome
