#pragma once

#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"

// The border of an observer's view, for diagrams.

namespace ergodome {

//! Border of an observer's picture: points in pseudo-Cartesian axes relative to the observer. They
//! are on a sphere of radius 1 or, for flat pictures, on a screen at distance 1.
struct ViewOutline {
  std::vector<Vector3<double>> border;  //!< closed curve; empty for a picture of all directions
  std::vector<Vector3<double>> corners;
};

//! Computes the border of a show's view in the frame of an observer without angular momentum at the
//! eye's position: a moving observer's directions are aberrated.
ViewOutline view_outline(const ViewSettings& view, const EyeCamera& eye);

//! Returns the direction of the middle of an eye's view, in the frame that view_outline() uses.
Vector3<double> forward_of(const EyeCamera& eye);

}  // namespace ergodome
