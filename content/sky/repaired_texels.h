#pragma once

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Light brighter than this is made as bright as this: the sun in any unit stays far below.
inline constexpr float brightest_texel = 1e9F;
//! Infinite light is made as bright as half floats go, which is where it mostly comes from: more would drown the sky.
inline constexpr float infinite_texel = 65504.0F;

//! Texels of a map that hold what is no light, each counted once.
struct RepairedTexels {
  long too_bright = 0;   //!< above brightest_texel, and now that bright, or infinite, and now infinite_texel
  long below_zero = 0;   //!< with a colour below 0, which is 0 now
  long not_numbers = 0;  //!< with a colour that is none; now black

  [[nodiscard]] long all() const { return too_bright + below_zero + not_numbers; }

  //! Whether a show's person is to be told. What filters and changes of gamut leave below zero is a matter of course.
  [[nodiscard]] bool are_a_mistake() const { return too_bright + not_numbers > 0; }
};

//! What they are: "3 texels infinite or brighter than 1e+09 (clamped), 1 texel with a negative color (set to 0)"; empty where there are none.
std::string repair_text(const RepairedTexels& texels);

//! A sentence for the person whose show names such a map, by its key ("sky.map") and its path in the show.
std::string note_of_repair(const Show& show, const std::string& key, const std::string& name,
                           const RepairedTexels& texels);

}  // namespace ergodome
