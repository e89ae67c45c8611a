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
    {GLFW_KEY_1, CalibrationAction::choose_tilt, "1          change the dome's tilt: up, down"},
    {GLFW_KEY_2, CalibrationAction::choose_rotation, "2          the picture's rotation: left, right"},
    {GLFW_KEY_3, CalibrationAction::choose_viewer, "3          the viewer's place: arrows, page up and down"},
    {GLFW_KEY_4, CalibrationAction::choose_top_left, "4 5 6 7    a corner, clockwise from the top left: arrows"},
    {GLFW_KEY_5, CalibrationAction::choose_top_right, ""},
    {GLFW_KEY_6, CalibrationAction::choose_bottom_right, ""},
    {GLFW_KEY_7, CalibrationAction::choose_bottom_left, ""},
    {GLFW_KEY_8, CalibrationAction::choose_gamma, "8          the projector's gamma: up, down"},
    {GLFW_KEY_9, CalibrationAction::choose_black_level, "9          its black level: up, down"},
    {GLFW_KEY_0, CalibrationAction::choose_gain,
     "0          its gain: up, down; press again for red, green or blue alone"},
    {GLFW_KEY_G, CalibrationAction::finer_grid, "G          finer grid of points: 3 x 3, 5 x 5, 9 x 9"},
    {GLFW_KEY_N, CalibrationAction::next_point, "N B        next, previous point of the grid: arrows"},
    {GLFW_KEY_B, CalibrationAction::previous_point, ""},
    {GLFW_KEY_LEFT, CalibrationAction::left, ""},
    {GLFW_KEY_RIGHT, CalibrationAction::right, ""},
    {GLFW_KEY_UP, CalibrationAction::up, ""},
    {GLFW_KEY_DOWN, CalibrationAction::down, ""},
    {GLFW_KEY_PAGE_UP, CalibrationAction::upwards, ""},
    {GLFW_KEY_PAGE_DOWN, CalibrationAction::downwards, ""},
    {GLFW_KEY_COMMA, CalibrationAction::finer, ", .        smaller, larger steps"},
    {GLFW_KEY_PERIOD, CalibrationAction::coarser, ""},
    {GLFW_KEY_BACKSPACE, CalibrationAction::undo, "Backspace  back to what was saved"},
    {GLFW_KEY_H, CalibrationAction::hide_text, "H          hide the text, show it"},
    {GLFW_KEY_F1, CalibrationAction::show_keys, "F1         hide or show these keys"},
    {GLFW_KEY_S, CalibrationAction::save, "S          save setup and warps; older files are kept as .bak"},
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
