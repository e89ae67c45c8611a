#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/navigation/controls/actions.h"
#include "app/navigation/controls/input_names.h"
#include "app/navigation/controls/steering.h"
#include "app/pads/state/pad_state.h"

namespace ergodome {

//! Mouse input since the last frame.
struct MouseState {
  double right_px = 0.0;  //!< distance dragged to the right with a button held
  double down_px = 0.0;
  double wheel_steps = 0.0;   //!< steps of the wheel; positive: up
  std::set<int> buttons;      //!< held buttons, from 0
  double radians_per_px = 0;  //!< angle of view per pixel of the window
};

//! Bindings of keys, mouse and controllers to actions and steering. A file can change them (see
//! reference/controls.md).
class Controls {
 public:
  //! An input that steers, and its factor.
  struct SteerBinding {
    Input input;
    double scale = 1.0;
  };

  //! Creates the default bindings.
  Controls();

  //! Returns the steering for held, moved and pressed inputs. `held_keys` are GLFW key codes. Keys
  //! with Ctrl or Alt do not steer unless bound that way; with Shift they do.
  [[nodiscard]] SteeringInput steering(const std::set<int>& held_keys, const MouseState& mouse,
                                       const PadState& pad) const;

  //! Returns the actions of a key that is pressed with the modifiers among the held keys.
  [[nodiscard]] std::vector<KeyAction> pressed(int key, const std::set<int>& held_keys) const;
  //! Returns the actions of the controller buttons pressed between two states.
  [[nodiscard]] std::vector<KeyAction> pressed(const PadState& before, const PadState& now) const;
  //! mouse_pressed() returns the actions of a mouse button, counted from 0. wheel_turned() returns
  //! the actions of a motion of the wheel, up if `steps` is positive: the bound action once for
  //! each whole step, at most 20 times. Fractions of a step are dropped.
  [[nodiscard]] std::vector<KeyAction> mouse_pressed(int button) const;
  [[nodiscard]] std::vector<KeyAction> wheel_turned(double steps) const;

  [[nodiscard]] const std::vector<Input>& inputs_of(KeyAction action) const;
  [[nodiscard]] const std::vector<SteerBinding>& inputs_of(double Steering::*component) const;

 private:
  friend Controls parse_controls(std::string_view text, const std::string& file);

  [[nodiscard]] KeyAction action_for(const Input& input) const;

  std::map<KeyAction, std::vector<Input>> actions_;
  std::vector<std::vector<SteerBinding>> steering_;  //!< in the order of all_steering()
};

//! Parses a file of controls. Binds the inputs that it names; other bindings keep their defaults,
//! except inputs that the file uses elsewhere. Throws Error with file and line for unknown names,
//! and for an input bound twice.
Controls parse_controls(std::string_view text, const std::string& file);
Controls read_controls(const std::filesystem::path& path);

//! Returns bindings as a file that parse_controls() reads, with a comment on each line.
std::string to_toml(const Controls& controls);

//! Returns the path of the user's controls, $XDG_CONFIG_HOME/ergodome/controls.toml (or ~/.config).
//! Returns an empty path if neither folder is known.
std::filesystem::path own_controls_path();

//! Returns the controls to use: from the file `chosen` if given, else from the user's file if it
//! exists, else the defaults.
Controls load_controls(const std::filesystem::path& chosen);

//! Writes the default controls to a new file. Throws Error if it exists or cannot be written.
void write_default_controls(const std::filesystem::path& path);

}  // namespace ergodome
