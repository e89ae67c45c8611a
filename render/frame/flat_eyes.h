#pragma once

#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Two pictures, left and right, and the distance of their eyes [M].
struct StereoPictures {
  std::vector<Picture> eyes;
  double baseline;
};

//! Renders both eyes of the stereo model `flat` through the head's lens: infinitely distant points
//! are where the head sees them, and the shadow is where flat space would have it.
//!
//! `head`: the head's picture, with the projection of eyes that do not converge. Reduces the
//! baseline if it does not fit.
StereoPictures render_flat_eyes(EyeRenderer& renderer, const EyePicture& head, const SkyCube& sky);

}  // namespace ergodome
