#pragma once

#include <vector>

#include "content/show.h"
#include "render/lens/eye_camera.h"

namespace ergodome {

//! Affine distances of what a show's disk and shells show a head in a direction of its view [M]: for the stereo model `flat`. Double rays.
std::vector<double> near_distances(const Show& show, const EyeCamera& head, const Vector3<double>& view);

}  // namespace ergodome
