#pragma once

#include <optional>
#include <span>

#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "kernels/projection/projection.h"
#include "render/passes/objects/placed_meshes.h"
#include "render/passes/objects/polygons/object_outline.h"

// Measures the disparities of a frame.

namespace ergodome {

//! Range of the disparities of a frame: the distance, in pixels and in arcminutes, by which a thing
//! is farther to the right in the right eye's image than in the left eye's. It is negative for
//! things nearer than the convergence distance, which appear in front of the screen.
struct Disparity {
  double min_px = 0.0;
  double max_px = 0.0;
  //! Minimum and maximum of the disparity, for a viewer in the middle of the dome, or at the
  //! position from which a flat screen spans the view's angles.
  double min_arcmin = 0.0;
  double max_arcmin = 0.0;

  //! Returns the width of the range, which a viewer has to fuse at once [degrees].
  [[nodiscard]] double range_deg() const { return (max_arcmin - min_arcmin) / 60.0; }
};

//! Measures the disparities of a frame with rays in double precision (benchmark stereo_disparity)
//! of:
//! - the sky, unless it is black: in many directions across the image in which no disk, shell or
//!   object hides it. Each is followed from the left eye's ray to the direction in which the right
//!   eye sees the same point of the sky; outliers are ignored (DisparityMeter::outlying_share). In
//!   the model `flat` the sky has only the disparity of convergence.
//! - the left and right edge of the shadow, in the model `physical`, if the picture shows it.
//! - disk, shells and objects, see add_near_things().
//!
//! `objects`: outlines of the show's objects (ShowRenderer::object_outlines()); `hiding`: objects
//! that hide sky, disk and shells behind them (hiding_objects()). Returns nothing for a single eye,
//! or if both eyes see no common direction.
std::optional<Disparity> frame_disparity(const Show& show, const CameraPose& pose, const Projection& projection,
                                         std::span<const PlacedOutline> objects, const PlacedMeshes& hiding);

}  // namespace ergodome
