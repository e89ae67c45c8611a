#pragma once

#include "content/show/show.h"
#include "kernels/projection/projection.h"

namespace ergodome {

//! Whether a view's pictures are those of a cube's faces, a file each.
inline bool has_face_files(const ViewSettings& view) {
  return view.projection == ViewProjection::cube && view.cube_files == CubeFiles::faces;
}

//! The projection of a show's view at a width [px], with another field of view than the show's unless that is 0 [deg]: as far as the
//! projection has one, and its lens can see.
//!
//! Pixels are square: screens, cylinders and cubes have the height that follows. A cube whose faces have files of their own comes as the
//! strip that they are cut from (cube_face_pictures), each of them as wide as was asked for.
Projection make_projection(const ViewSettings& view, int width_px, double field_of_view_deg);

//! The image of an eye that sits `offset` M to the right of the head, so that what is `convergence` M away is at one place in both eyes'
//! images: a frustum off its axis, onto a plane at that distance; a dome seen from beside its middle, which is a sphere of that radius.
//! Other projections stay, and 0 stands for infinity. Throws Error where the eye would be at the dome's surface.
Projection converged_projection(const Projection& projection, double offset, double convergence);

}  // namespace ergodome
