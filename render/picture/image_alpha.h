#pragma once

#include "kernels/projection/projection.h"
#include "render/picture/picture.h"

namespace ergodome {

//! Sets a picture's alpha channel to the coverage of its image: 1 inside a dome's circle, 0
//! outside, a fraction on the rim. The hole's shadow is opaque like the rest. `projection`: the
//! picture's own.
void set_image_alpha(const Projection& projection, Picture& picture);

}  // namespace ergodome
