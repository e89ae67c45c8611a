#pragma once

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Brighter light is clamped to this value, which is far above the Sun in any unit.
inline constexpr float brightest_texel = 1e9F;
//! Infinite light becomes the maximum of half floats, where it usually comes from; a larger value
//! would drown the sky.
inline constexpr float infinite_texel = 65504.0F;

//! Numbers of invalid texels that were repaired, each counted once.
struct RepairedTexels {
  long too_bright = 0;   //!< above brightest_texel and clamped to it, or infinite and set to infinite_texel
  long below_zero = 0;   //!< with a negative color component, set to 0
  long not_numbers = 0;  //!< with a NaN color component, set to black

  [[nodiscard]] long all() const { return too_bright + below_zero + not_numbers; }

  //! Returns true if the user should be warned. Negative values are normal results of filters and
  //! gamut conversions.
  [[nodiscard]] bool are_a_mistake() const { return too_bright + not_numbers > 0; }
};

//! Returns a text such as "3 texels infinite or brighter than 1e+09 (clamped), 1 texel with a
//! negative color (set to 0)"; empty without repaired texels.
std::string repair_text(const RepairedTexels& texels);

//! Returns a note about repaired texels of a show's map, with its key ("sky.map") and its path in
//! the show.
std::string note_of_repair(const Show& show, const std::string& key, const std::string& name,
                           const RepairedTexels& texels);

}  // namespace ergodome
