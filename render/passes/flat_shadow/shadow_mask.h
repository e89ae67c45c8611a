#pragma once

#include "kernels/spacetime/shadow/edge_curve.h"
#include "render/picture/picture.h"

namespace ergodome {

//! Darkens the head's picture where an eye sees the shadow. `head` and `eye` are the edges of the
//! shadow that the head and the eye see, in the view's axes, in host memory. The eye's shadow
//! contains the head's; pixels where the edges coincide stay bit-identical.
void mask_shadow(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye);

}  // namespace ergodome
