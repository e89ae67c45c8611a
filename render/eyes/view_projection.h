#pragma once

#include "content/show/show.h"
#include "kernels/projection/projection.h"

// Projections of a show's view.

namespace ergodome {

//! Returns whether a view's pictures are the faces of a cube, with a file for each.
inline bool has_face_files(const ViewSettings& view) {
  return view.projection == ViewProjection::cube && view.cube_files == CubeFiles::faces;
}

//! Returns the projection of a show's view at a width [px]. `field_of_view_deg`, unless it is 0,
//! replaces the field of view of domes and of pinholes without `frustum`. The field of view of a
//! dome is limited to what its lens can show.
//!
//! Pixels are square; the height of screens, cylinders and cubes follows from the width. A cube
//! with a file per face is rendered as a strip, from which cube_face_pictures cuts the faces; each
//! face has the requested width.
Projection make_projection(const ViewSettings& view, int width_px, double field_of_view_deg);

//! Returns the projection for an eye that is `offset` M to the right of the head, such that objects
//! at distance `convergence` [M] appear at the same position for both eyes. Flat screens get an
//! off-axis frustum with the screen plane at that distance; domes are viewed from beside the center
//! of a sphere with that radius. Other projections do not change, and none does if `convergence` is
//! 0 (infinity). Throws Error if the eye would be 0.95 radii or more from the dome's center.
Projection converged_projection(const Projection& projection, double offset, double convergence);

}  // namespace ergodome
