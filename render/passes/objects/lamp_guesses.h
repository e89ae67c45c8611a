#pragma once

#include <vector>

#include "content/show/object_settings.h"
#include "kernels/objects/lamp_place.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! Computes how spin changes a lamp's rays to the middle of each object; there is one outline per
//! object. Rays to the rest of an object are found much faster from there. The result is 0 without
//! spin, for unlit objects, and for objects that appear wide from the hole.
std::vector<LampCorrections> lamp_guesses(Spacetime spacetime, const LampPlace& lamp,
                                          const std::vector<ObjectSettings>& objects,
                                          const std::vector<PlacedOutline>& outlines);

}  // namespace ergodome
