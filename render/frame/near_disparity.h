#pragma once

#include <span>

#include "render/frame/disparity_meter.h"
#include "render/objects/object_outline.h"

namespace ergodome {

//! Adds what stands near the hole to the disparities of a frame: places of disk and shells in directions across the image, and those of objects that are
//! nearest to the head and farthest from it, by light that comes the short way round. What hides what is not asked. In the model `flat` things stand where flat
//! space has them, and longer ways round count for disk and shells.
void add_near_things(const Show& show, const CameraPose& pose, const Projection& projection,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter);

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

}  // namespace ergodome
