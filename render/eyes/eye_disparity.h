#pragma once

#include <optional>
#include <span>

#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "kernels/projection/projection.h"
#include "render/passes/objects/placed_meshes.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! How far to the right the right eye sees things of where the left one does, for a viewer who looks there: negative is nearer than where the eyes converge, in front of the screen.
struct Disparity {
  double least_px = 0.0;
  double greatest_px = 0.0;
  double least_arcmin = 0.0;  //!< for a viewer at the middle of the dome, or where the screen has the view's own angles
  double greatest_arcmin = 0.0;

  //! The difference that a person has to fuse at once [degrees].
  [[nodiscard]] double range_deg() const { return (greatest_arcmin - least_arcmin) / 60.0; }
};

//! The disparities of a frame: of the sky, where neither disk, shells nor objects hide it and unless it is black, of many directions across the image, each followed from the
//! left eye's ray to where the right eye sees the same star, but for the outermost (DisparityMeter::outlying_share); of the shadow's edge to both sides, in the model `physical`, where a
//! picture shows it; and of what stands near the hole, see add_near_things. `objects`: the outlines of the show's objects (ShowRenderer::object_outlines); `hiding`: those that hide sky,
//! disk and shells behind them (hiding_objects). Double rays (benchmark stereo_disparity). Nothing for one eye, or where no direction is seen by both.
//!
//! In the model `flat` the sky has none but what convergence gives it.
std::optional<Disparity> frame_disparity(const Show& show, const CameraPose& pose, const Projection& projection,
                                         std::span<const PlacedOutline> objects, const PlacedMeshes& hiding);

}  // namespace ergodome
