#pragma once

#include <vector>

#include "content/objects/object_settings.h"
#include "kernels/mesh/lamp_place.h"
#include "render/objects/object_outline.h"

namespace ergodome {

//! What spin adds to a lamp's rays at some places of the lit objects, one outline each: in the middle of what is small, on eight corners of what is not, as far from each
//! other as can be. Rays to the rest of an object are found from there in a fifth of the time. None about a hole without spin, which adds nothing.
std::vector<LampGuess> lamp_guesses(double spin, const LampPlace& lamp, const std::vector<ObjectSettings>& objects,
                                    const std::vector<PlacedOutline>& outlines);

}  // namespace ergodome
