#pragma once

#include "content/camera/camera_path.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Returns the maximum baseline [M] of the model `omni` at a pose, from the position alone: at most
//! the head's distance from the horizon and 0.72 r. For infalling heads within 1.2 horizon radii,
//! at most the value at that height and the remaining depth. Smooth enough that nothing jumps along
//! a camera path.
//!
//! The polynomials of ODS eyes (OmniCamera) converge where the cameras are regular: up to the
//! horizon and to about r. If the head is much faster than infalling observers, or at rest next to
//! the ergosphere, less may fit; greatest_baseline() checks that.
double omni_room(Spacetime spacetime, const CameraPose& pose);

//! Returns the maximum baseline [M] of a show's stereo model at a pose. `physical`: infinity, as
//! eyes are kept outside the hole. `flat`: the affine distance of the horizon. `omni`: omni_room(),
//! or less if the eyes cannot be drawn. Throws Error if eye_camera() does.
double greatest_baseline(const Show& show, const CameraPose& pose);

//! Returns the show's baseline at a pose [M]: stereo.baseline, limited to greatest_baseline().
double fitting_baseline(const Show& show, const CameraPose& pose);

}  // namespace ergodome
