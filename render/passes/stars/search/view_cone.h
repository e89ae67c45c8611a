#pragma once

#include "kernels/projection/projection.h"
#include "kernels/stars/search/search_inputs.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Returns the cone that contains a picture, enlarged by `margin` [rad]; the whole sky for pictures
//! that wrap around and for cubes.
ViewCone view_cone(const EyeCamera& eye, const Projection& projection, double margin);

//! Returns the view enlarged by `margin` [rad].
ViewCone widened(const ViewCone& view, double margin);

//! Returns whether the cone `outer` contains the cone `inner`, within 1e-6 rad.
bool holds(const ViewCone& outer, const ViewCone& inner);

}  // namespace ergodome
