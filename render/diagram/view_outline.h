#pragma once

#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Border of what an observer's picture shows: from the observer, in pseudo-Cartesian axes, to a sphere of radius 1 or, where the picture is flat, to
//! a screen at distance 1.
struct ViewOutline {
  std::vector<Vector3<double>> border;  //!< round about; empty for a picture of the whole sky
  std::vector<Vector3<double>> corners;
};

//! The border of a show's view, as an observer at rest (without angular momentum) at the eye's place would point it out: a moving observer's
//! directions are aberrated.
ViewOutline view_outline(const ViewSettings& view, const EyeCamera& eye);

//! Where the middle of an eye's view points to, in the same sense as the border.
Vector3<double> forward_of(const EyeCamera& eye);

}  // namespace ergodome
