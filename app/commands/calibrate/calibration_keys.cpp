#include "app/commands/calibrate/calibration_keys.h"

#include <GLFW/glfw3.h>

namespace ergodome {

namespace {

struct Binding {
  int key;
  CalibrationAction action;
  const char* help;
};

constexpr Binding bindings[] = {
    {GLFW_KEY_TAB, CalibrationAction::next_projector, "Tab        next projector"},
    {GLFW_KEY_P, CalibrationAction::next_pattern, "P O        next, previous test pattern"},
    {GLFW_KEY_O, CalibrationAction::previous_pattern, ""},
    {GLFW_KEY_1, CalibrationAction::choose_tilt, "1          adjust the dome's tilt (up, down)"},
    {GLFW_KEY_2, CalibrationAction::choose_rotation, "2          adjust the picture's rotation (left, right)"},
    {GLFW_KEY_3, CalibrationAction::choose_viewer,
     "3          adjust the viewer's position (arrows, page up, page down)"},
    {GLFW_KEY_4, CalibrationAction::choose_top_left, "4 5 6 7    move a corner, clockwise from the top left (arrows)"},
    {GLFW_KEY_5, CalibrationAction::choose_top_right, ""},
    {GLFW_KEY_6, CalibrationAction::choose_bottom_right, ""},
    {GLFW_KEY_7, CalibrationAction::choose_bottom_left, ""},
    {GLFW_KEY_8, CalibrationAction::choose_gamma, "8          adjust the projector's gamma (up, down)"},
    {GLFW_KEY_9, CalibrationAction::choose_black_level, "9          adjust its black level (up, down)"},
    {GLFW_KEY_0, CalibrationAction::choose_gain,
     "0          adjust its gain (up, down); press again for only red, green or blue"},
    {GLFW_KEY_G, CalibrationAction::finer_grid, "G          use a finer grid of points: 3 x 3, 5 x 5, 9 x 9"},
    {GLFW_KEY_N, CalibrationAction::next_point, "N B        move the next, previous point of the grid (arrows)"},
    {GLFW_KEY_B, CalibrationAction::previous_point, ""},
    {GLFW_KEY_LEFT, CalibrationAction::left, ""},
    {GLFW_KEY_RIGHT, CalibrationAction::right, ""},
    {GLFW_KEY_UP, CalibrationAction::up, ""},
    {GLFW_KEY_DOWN, CalibrationAction::down, ""},
    {GLFW_KEY_PAGE_UP, CalibrationAction::upwards, ""},
    {GLFW_KEY_PAGE_DOWN, CalibrationAction::downwards, ""},
    {GLFW_KEY_COMMA, CalibrationAction::finer, ", .        smaller, larger steps"},
    {GLFW_KEY_PERIOD, CalibrationAction::coarser, ""},
    {GLFW_KEY_BACKSPACE, CalibrationAction::undo, "Backspace  restore the saved value"},
    {GLFW_KEY_H, CalibrationAction::hide_text, "H          hide or show the text"},
    {GLFW_KEY_F1, CalibrationAction::show_keys, "F1         hide or show this list of keys"},
    {GLFW_KEY_S, CalibrationAction::save, "S          save the setup and warps; keeps older files as .bak"},
    {GLFW_KEY_ESCAPE, CalibrationAction::quit, "Esc        quit without saving"},
};

}  // namespace

CalibrationAction calibration_action_of(int key) {
  for (const Binding& binding : bindings) {
    if (binding.key == key) {
      return binding.action;
    }
  }
  return CalibrationAction::none;
}

std::string calibration_key_lines(const std::string& indent) {
  std::string text;
  for (const Binding& binding : bindings) {
    if (*binding.help != '\0') {
      text += indent + binding.help + "\n";
    }
  }
  return text;
}

}  // namespace ergodome
