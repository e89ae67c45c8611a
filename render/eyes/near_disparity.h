#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/eyes/disparity_meter.h"
#include "render/eyes/near_sights.h"
#include "render/lens/spread_point.h"
#include "render/passes/objects/polygons/object_outline.h"

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

//! The same for many that are spread evenly without symmetries of their own.
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

//! What disparities are looked for in a direction; what the head sees there of disk and shells is asked in all, as it hides the sky. For the sky there are many, as it is
//! stretched without bound beside its caustics.
enum class LookedFor : std::uint8_t { sky, disk_and_shells };

//! A direction across an image, in the view's axes, and what of disk and shells the head sees there.
struct SeenDirection {
  Vector3<double> view;
  LookedFor looked_for;
  std::vector<NearSight> sights;  //!< see near_sights; what objects hide is not among them
  bool ends_at_object = false;

  [[nodiscard]] bool shows_sky() const { return !ends_at_object && (sights.empty() || !sights.back().opaque); }
};

//! Whether nothing is seen of a sky.
bool is_black(const SkySettings& sky);

//! The directions in which a frame's disparities are looked at; none for the sky where it is black. `hiding`: objects that hide what is behind them.
std::vector<SeenDirection> seen_directions(const Show& show, const CameraPose& pose, const Projection& projection,
                                           const PlacedMeshes& hiding);

//! Adds what stands near the hole to the disparities of a frame, where a picture shows it: places of disk and shells in some directions, up to what
//! is opaque, and of the sixteen nearest objects the nearest, the farthest and the outermost places, which nothing hides. Light comes to both eyes the short way
//! round, and neither end is within 2 M of the hole's middle. In the model `flat` things stand where flat space has them; there disk and shells count wherever
//! they are, and the long way round, too.
void add_near_things(const Show& show, const CameraPose& pose, std::span<const SeenDirection> directions,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter);

}  // namespace ergodome
