#pragma once

#include "content/camera/camera_path.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Returns an upper limit of the baseline [M] for the model `omni`, from the head's position alone:
//! the head's distance from the horizon, but at most 0.72 r. For infalling heads within 1.2 horizon
//! radii, two other limits replace the distance from the horizon: the limit at 1.2 horizon radii,
//! and the distance to the minimum radius. The result is smooth enough that the image does not jump
//! along a camera path.
//!
//! The polynomials of ODS eyes (OmniCamera) converge where the cameras are regular: up to the
//! horizon and to about r. If the head moves much faster than infalling observers, or is at rest
//! next to the ergosphere, the possible baseline may be smaller; max_baseline() takes that into
//! account.
double omni_room(Spacetime spacetime, const CameraPose& pose);

//! Returns the maximum baseline [M] of a show's stereo model at a pose. `physical`: infinity, as
//! eyes are kept outside the hole. `flat`: the affine distance of the horizon. `omni`: omni_room(),
//! or less if the ODS cameras cannot be fitted. Throws Error if eye_camera() does.
double max_baseline(const Show& show, const CameraPose& pose);

//! Returns the baseline used at a pose [M]: the show's, limited to max_baseline(). Throws Error
//! like that function.
double fitting_baseline(const Show& show, const CameraPose& pose);

}  // namespace ergodome
