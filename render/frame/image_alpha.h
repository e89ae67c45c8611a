#pragma once

#include "kernels/projection/projection.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Gives a picture the coverage of its image, for an alpha channel: 1 in a dome's circle and 0 outside of it, the part of a pixel on the rim; the hole's shadow
//! covers what the picture is laid over as all the rest does. `projection`: the picture's own.
void set_image_alpha(const Projection& projection, Picture& picture);

}  // namespace ergodome
