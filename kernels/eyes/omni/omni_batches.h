#pragma once

#include "kernels/lens/grid_build.h"
#include "kernels/lens/look_up.h"
#include "kernels/spacetime/trace/omni_camera.h"
#include "kernels/stars/star_images.h"

namespace ergodome {

//! Batches of omnidirectional eyes. The kernels are those of a single camera; directions are in the
//! view's axes.
using OmniNodeBatch = NodeBatch<float, OmniCameraOf<float>>;
using OmniCheckBatch = CheckBatch<float, OmniCameraOf<float>>;
template <class S>
using OmniStarBatch = StarImageBatch<S, OmniCameraOf<S>>;

}  // namespace ergodome
