#pragma once

#include "content/show/show.h"
#include "render/picture/picture.h"

namespace ergodome {

//! Scatters light in place: (1 - strength) * picture + strength * blurred. Coverage does not
//! change.
//!
//! The total light is conserved: light that would leave the picture is reflected at its borders
//! (except for small deviations beside a border if a size does not halve evenly). A uniform picture
//! does not change. Non-finite values scatter nothing and stay where they are. Works for any size.
//! Needs a third to half of the picture's memory.
//!
//! Sums a chain of downsampled pictures (Jimenez, "Next generation post processing in Call of Duty:
//! Advanced Warfare", SIGGRAPH 2014). Takes tens of nanoseconds per pixel, independent of the
//! radius.
void add_bloom(Picture& picture, const BloomSettings& settings);

}  // namespace ergodome
