#pragma once

#include <vector>

#include "content/objects/object_settings.h"
#include "kernels/objects/lamp_place.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! What spin adds to a lamp's rays to the middle of each object, with one outline each: rays to the rest of it are found from there in a part of the
//! time. 0 without spin, for objects that are not lit, and for those that are wide as seen from the hole.
std::vector<LampCorrections> lamp_guesses(double spin, const LampPlace& lamp,
                                          const std::vector<ObjectSettings>& objects,
                                          const std::vector<PlacedOutline>& outlines);

}  // namespace ergodome
