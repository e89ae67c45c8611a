#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Returns a number with its noun for messages: "1 gap", "2 gaps", "0 gaps". `several` is the
//! plural, if it is not the noun with an s.
template <class Integer>
std::string counted(Integer count, std::string_view noun, std::string_view several = {}) {
  std::string text = std::to_string(count) + ' ';
  text += count == 1 || several.empty() ? noun : several;
  return count != 1 && several.empty() ? text + 's' : text;
}

}  // namespace ergodome
