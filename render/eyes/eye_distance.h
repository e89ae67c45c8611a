#pragma once

#include "content/camera/camera_path.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! How far eyes of the model `omni` may be apart at a pose, by the place alone [M]. No farther than the horizon is from the head, and no farther than
//! 0.72 r. Of heads that fall, within 1.2 horizon radii, no farther than at that height, and than the depth that is left. Smooth enough that nothing
//! leaps on a camera's way.
//!
//! The polynomials of such eyes (OmniCamera) converge as far as their cameras are regular: to the horizon, and to about r. Where the head is much
//! faster than who falls, or at rest next to the ergosphere, less may fit than this: greatest_baseline() looks.
double omni_room(double spin, const CameraPose& pose);

//! Greatest distance that both eyes of a show's stereo model can have at a pose [M]; infinity for the model `physical`, whose eyes wait outside the hole.
//! `flat`: the affine distance of the horizon. `omni`: omni_room(), or less where such eyes cannot be drawn so far apart. Throws Error where
//! eye_camera() does.
double greatest_baseline(const Show& show, const CameraPose& pose);

//! How far the show's eyes are apart at a pose [M]: as far as stereo.baseline says, but no farther than greatest_baseline().
double fitting_baseline(const Show& show, const CameraPose& pose);

}  // namespace ergodome
