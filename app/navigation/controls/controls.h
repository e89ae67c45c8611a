#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/navigation/controls/actions.h"
#include "app/navigation/controls/input_names.h"
#include "app/navigation/navigator.h"
#include "app/pads/pad_state.h"

namespace ergodome {

//! What a mouse did since the last frame.
struct MouseState {
  double right_px = 0.0;  //!< dragged: with a button held
  double down_px = 0.0;
  double wheel_steps = 0.0;   //!< upwards
  std::set<int> buttons;      //!< that are held, from 0
  double radians_per_px = 0;  //!< angle of the view that a pixel of the window is
};

//! How a help stands on the page: in columns, for letters of one width; as lines of cells parted by tabs, for fit_list(); or as lines of
//! words for any letters, of the pad alone where there is one.
enum class HelpForm { columns, cells, words };

//! What a help lists.
struct HelpChoice {
  bool pads = true;                           //!< a column for them, too
  ActionUser reader = ActionUser::presenter;  //!< visitors get their own actions alone
  std::string_view language = "en";           //!< "de", or English
  HelpForm form = HelpForm::columns;
};

//! Assignments of keys, mouse and pads to actions and steering, which a file may change (see reference/controls.md).
class Controls {
 public:
  //! An input that steers, and how much.
  struct SteerBinding {
    Input input;
    double scale = 1.0;
  };

  //! As the program has them.
  Controls();

  //! What is held, moved and pressed, as steering. `held_keys` by GLFW's numbers. Keys with Ctrl or Alt do not steer, unless bound so; with
  //! Shift they do.
  [[nodiscard]] SteeringInput steering(const std::set<int>& held_keys, const MouseState& mouse,
                                       const PadState& pad) const;

  //! What a key does that goes down while the others are held.
  [[nodiscard]] std::vector<KeyAction> pressed(int key, const std::set<int>& held_keys) const;
  //! What the buttons of a pad do that went down between two states.
  [[nodiscard]] std::vector<KeyAction> pressed(const PadState& before, const PadState& now) const;
  //! What a button of the mouse does, counted from 0; or a step of its wheel, up where positive.
  [[nodiscard]] std::vector<KeyAction> mouse_pressed(int button) const;
  [[nodiscard]] std::vector<KeyAction> wheel_turned(double steps) const;

  //! The map as lines for people: keys and mouse, pad, what they do now; columns are for letters of one width. What is bound to nothing is
  //! left out.
  [[nodiscard]] std::string help_text(const HelpChoice& choice) const;

  [[nodiscard]] const std::vector<Input>& inputs_of(KeyAction action) const;
  [[nodiscard]] const std::vector<SteerBinding>& inputs_of(double Steering::*component) const;

  //! The map as a file that reads back to it, with what each line does.
  [[nodiscard]] std::string to_toml() const;

 private:
  friend Controls parse_controls(std::string_view text, const std::string& file);

  [[nodiscard]] KeyAction action_for(const Input& input) const;

  std::map<KeyAction, std::vector<Input>> actions_;
  std::vector<std::vector<SteerBinding>> steering_;  //!< in the order of all_steering()
};

//! Reads a map of controls. What it names is bound as it says; the rest stays as it is but for inputs that the file gives to something
//! else. Throws Error with file and line for unknown names, and for an input that the file binds twice.
Controls parse_controls(std::string_view text, const std::string& file);
Controls read_controls(const std::filesystem::path& path);

//! The user's own map at $XDG_CONFIG_HOME/ergodome/controls.toml (or ~/.config); empty where neither folder is known.
std::filesystem::path own_controls_path();

//! The map to play with: `chosen` where it names a file, the user's own where there is one, and the program's otherwise.
Controls load_controls(const std::filesystem::path& chosen);

//! Writes the program's map as a file to begin with. Throws Error where that cannot be, or where there is one.
void write_default_controls(const std::filesystem::path& path);

}  // namespace ergodome
