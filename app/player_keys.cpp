#include "app/player_keys.h"

#include <GLFW/glfw3.h>

namespace ergodome {

namespace {

struct Binding {
  int key;
  KeyAction action;
  const char* help;
};

constexpr Binding bindings[] = {
    {GLFW_KEY_ESCAPE, KeyAction::quit, "Esc        quit"},
    {GLFW_KEY_SPACE, KeyAction::pause, "Space      pause, go on"},
    {GLFW_KEY_LEFT, KeyAction::seek_back, "Left       back 2 s"},
    {GLFW_KEY_RIGHT, KeyAction::seek_forward, "Right      forward 2 s"},
    {GLFW_KEY_HOME, KeyAction::restart, "Home       to the start, back to the show's path"},
    {GLFW_KEY_TAB, KeyAction::fly, "Tab        free flight, back to the show"},
    {GLFW_KEY_F11, KeyAction::full_screen, "F11        full screen"},
    {GLFW_KEY_V, KeyAction::next_view, "V          next view: sky, steps, error, order, g, magnification"},
    {GLFW_KEY_I, KeyAction::times, "I          show the frame time and the lens in the picture"},
    {GLFW_KEY_A, KeyAction::left, "A D        orbit against, with +phi"},
    {GLFW_KEY_D, KeyAction::right, ""},
    {GLFW_KEY_R, KeyAction::up, "R F        orbit north, south"},
    {GLFW_KEY_F, KeyAction::down, ""},
    {GLFW_KEY_W, KeyAction::in, "W S        towards the hole, away from it"},
    {GLFW_KEY_S, KeyAction::out, ""},
    {GLFW_KEY_LEFT_BRACKET, KeyAction::baseline_smaller, "[ ]        eyes nearer to each other, farther apart"},
    {GLFW_KEY_RIGHT_BRACKET, KeyAction::baseline_larger, ""},
    {GLFW_KEY_BACKSPACE, KeyAction::baseline_reset, "Backspace  baseline and convergence as the show has them"},
    {GLFW_KEY_COMMA, KeyAction::convergence_nearer, ", .        eyes converge nearer, farther, at infinity"},
    {GLFW_KEY_PERIOD, KeyAction::convergence_farther, ""},
    {GLFW_KEY_X, KeyAction::swap_eyes, "X          swap the eyes"},
    {GLFW_KEY_T, KeyAction::tint_eyes, "T          tint the eyes: left reddish, right cyan"},
    {GLFW_KEY_L, KeyAction::next_layout, "L          next stereo layout"},
    {GLFW_KEY_M, KeyAction::next_model, "M          next stereo model: physical, flat, omni"},
};

}  // namespace

KeyAction action_of(int key) {
  for (const Binding& binding : bindings) {
    if (binding.key == key) {
      return binding.action;
    }
  }
  return KeyAction::none;
}

std::string key_help() {
  std::string text = "Keys:\n";
  for (const Binding& binding : bindings) {
    if (*binding.help != '\0') {
      text += std::string("  ") + binding.help + "\n";
    }
  }
  return text + "  mouse      drag to look around, wheel to zoom";
}

}  // namespace ergodome
