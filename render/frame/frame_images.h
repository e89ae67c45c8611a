#pragma once

#include <vector>

#include "content/show/show.h"
#include "render/picture/picture.h"

namespace ergodome {

//! Returns the images that files of a frame contain: one that the stereo layout combines from both
//! eyes, or one per eye if it stores them separately (keeps_eyes_apart()); six times as many if
//! each face of a cube has its own file.
//!
//! `eyes`: the picture of one eye, or those of the left and the right one; `projection`: theirs.
std::vector<FrameImage> frame_images(std::vector<Picture> eyes, const Projection& projection, const Show& show);

}  // namespace ergodome
