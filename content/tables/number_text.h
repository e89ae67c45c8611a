#pragma once

#include <cstddef>
#include <string_view>

namespace ergodome {

//! Room for a number's text [bytes]; the text itself has at most 24.
inline constexpr std::size_t room_for_number = 48;

//! Writes a number with up to 17 significant digits, which identify a double, or up to 9, which identify a float, in the
//! formats "{:.17g}" and "{:.9g}" of fmt. Returns the end of the text; `to` has room for room_for_number bytes.
char* write_number(char* to, double value);
char* write_number(char* to, float value);

//! Appends a number, as write_number() writes it.
template <class Text, class Real>
void append_number(Text& text, Real value) {
  char digits[room_for_number];
  text.append(digits, static_cast<std::size_t>(write_number(digits, value) - digits));
}

}  // namespace ergodome
