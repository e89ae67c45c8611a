#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! Something that can be pressed, turned or moved.
struct Input {
  enum class Kind { key, mouse_button, mouse_axis, wheel, wheel_step, pad_button, pad_axis };
  Kind kind = Kind::key;
  int code =
      0;  //!< a key by GLFW's number; a mouse's button from 0; x, y; a wheel's step up or down; the place in PadButton or PadAxis
  unsigned modifiers = 0;  //!< of a key

  auto operator<=>(const Input&) const = default;
};

inline constexpr unsigned shift_held = 1;
inline constexpr unsigned ctrl_held = 2;
inline constexpr unsigned alt_held = 4;

//! An input by its name: "Space", "Ctrl+R", "mouse.left", "wheel.up", "pad.south", "pad.left_x"; nothing where there is none of that name.
std::optional<Input> input_of(std::string_view name);

//! The name of an input as input_of reads it.
std::string name_of(const Input& input);

//! What is printed on it, or it is called, in a language of the help ("de"; else English): "[", "A / Cross", "Leertaste", "Strg+R".
std::string label_of(const Input& input, std::string_view language = "en");

//! Every name, without modifiers.
const std::vector<std::string>& input_names();

//! The modifiers among held keys, by GLFW's numbers.
unsigned modifier_of(int key);

}  // namespace ergodome
