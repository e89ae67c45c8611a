#pragma once

#include <vector>

#include "content/show/object_settings.h"
#include "kernels/objects/lamp_source.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! Computes, for each object's center, how the hole's spin changes the lamp's rays to it on both
//! ways round the hole. The search for rays to the rest of the object is much faster when it starts
//! from these corrections. The corrections are 0 without spin, for unlit objects, for centers next
//! to the horizon, and for objects that appear wide from the hole. `outlines` has one entry per
//! object.
std::vector<LampCorrections> lamp_guesses(Spacetime spacetime, const LampSource& lamp,
                                          const std::vector<ObjectSettings>& objects,
                                          const std::vector<PlacedOutline>& outlines);

}  // namespace ergodome
