#pragma once

#include "kernels/spacetime/shadow/edge_curve.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Darkens a picture of the head's where an eye sees the shadow: `head` and `eye` are the edges that both see, in the view's axes, on the host.
//! The eye's shadow holds the head's; where both edges are one, pixels stay as they are to the bit.
void mask_shadow(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye);

}  // namespace ergodome
