#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! An input: something that can be pressed, turned or moved.
struct Input {
  enum class Kind { key, mouse_button, mouse_axis, wheel, wheel_step, pad_button, pad_axis };
  Kind kind = Kind::key;
  //! Depends on the kind of input: GLFW key code, mouse button from 0, mouse axis 0 (x) or 1 (y),
  //! wheel step 1 (up) or -1 (down), or index in PadButton or PadAxis. 0 for the whole wheel.
  int code = 0;
  unsigned modifiers = 0;  //!< modifier flags of a key

  auto operator<=>(const Input&) const = default;
};

inline constexpr unsigned shift_held = 1;
inline constexpr unsigned ctrl_held = 2;
inline constexpr unsigned alt_held = 4;

//! Returns the input with a name such as "Space", "Ctrl+R", "mouse.left", "wheel.up", "pad.south"
//! or "pad.left_x"; nothing if there is none.
std::optional<Input> input_of(std::string_view name);

//! Returns the name of an input as input_of() reads it.
std::string name_of(const Input& input);

//! Returns the label of an input in a language of the help ("de", otherwise English): "[",
//! "Leertaste", "A / Cross", "Strg+R".
std::string label_of(const Input& input, std::string_view language = "en");

//! Returns all names, without modifiers.
const std::vector<std::string>& input_names();

//! Returns the modifier flag of a key with this GLFW key code; 0 for other keys.
unsigned modifier_of(int key);

}  // namespace ergodome
