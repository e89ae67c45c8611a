#pragma once

#include "kernels/spacetime/shadow/edge_curve.h"
#include "render/picture/picture.h"

namespace ergodome {

//! Darkens the head's picture where an eye sees the shadow. `head` and `eye` are the shadow edges
//! that both see, in the view's axes, on the host. The eye's shadow contains the head's; where the
//! edges coincide, pixels stay bit-identical.
void mask_shadow(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye);

}  // namespace ergodome
