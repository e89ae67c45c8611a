#pragma once

#include <vector>

#include "render/stars/bezier_patch.h"

namespace ergodome {

//! How a patch maps the chart to the sky.
enum class PatchShape {
  regular,  //!< nearly affine: Newton's method finds the only image of a star from anywhere
  bent,     //!< one to one, but its middle does not speak for all of it
  folded    //!< a critical curve runs through it: there may be several images, however bright
};

//! Where a patch has p = q = 0.
struct Root {
  float u;
  float v;
};

//! Appends the roots of a patch within [0, 1]² and a hair beyond, so that on a border neither side loses one: none or one for patches
//! that are not folded.
void find_roots(const PlanePatch& plane, PatchShape shape, std::vector<Root>& roots);

}  // namespace ergodome
