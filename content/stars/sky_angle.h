#pragma once

#include <optional>
#include <string_view>

namespace ergodome {

//! The unit that a mark after the first part of a coordinate states.
enum class AngleMark { none, hours, degrees };

//! A coordinate as written in a table.
struct SkyAngle {
  double value = 0.0;  //!< value in the unit of the coordinate's first part
  AngleMark mark = AngleMark::none;
  bool sexagesimal = false;  //!< the coordinate has minutes
};

//! Parses a decimal number or a sexagesimal coordinate: `05 14 32.27`, `05:14:32.27`,
//! `5h14m32.27s`, `-08 12 05.9`, `+89°15′51″`. A sign applies to all parts, so `-00 30 00` is -0.5.
//! Returns nothing for other text, minutes of 60 or more, seconds above 60, and decimals before the
//! last part.
std::optional<SkyAngle> parse_sky_angle(std::string_view text);

}  // namespace ergodome
