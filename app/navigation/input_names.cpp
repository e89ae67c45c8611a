#include "app/navigation/input_names.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "calibration/pad_state.h"

namespace ergodome {

namespace {

struct Named {
  Input::Kind kind;
  int code;
  std::string name;
  std::string label;
};

struct NamedKey {
  int key;
  const char* name;
  const char* label;
};

constexpr NamedKey special_keys[] = {
    {GLFW_KEY_SPACE, "Space", "Space"},
    {GLFW_KEY_APOSTROPHE, "Apostrophe", "'"},
    {GLFW_KEY_COMMA, "Comma", ","},
    {GLFW_KEY_MINUS, "Minus", "-"},
    {GLFW_KEY_PERIOD, "Period", "."},
    {GLFW_KEY_SLASH, "Slash", "/"},
    {GLFW_KEY_SEMICOLON, "Semicolon", ";"},
    {GLFW_KEY_EQUAL, "Equal", "="},
    {GLFW_KEY_LEFT_BRACKET, "LeftBracket", "["},
    {GLFW_KEY_BACKSLASH, "Backslash", "\\"},
    {GLFW_KEY_RIGHT_BRACKET, "RightBracket", "]"},
    {GLFW_KEY_GRAVE_ACCENT, "GraveAccent", "`"},
    {GLFW_KEY_WORLD_1, "World1", "World1"},
    {GLFW_KEY_WORLD_2, "World2", "World2"},
    {GLFW_KEY_ESCAPE, "Escape", "Esc"},
    {GLFW_KEY_ENTER, "Enter", "Enter"},
    {GLFW_KEY_TAB, "Tab", "Tab"},
    {GLFW_KEY_BACKSPACE, "Backspace", "Backspace"},
    {GLFW_KEY_INSERT, "Insert", "Insert"},
    {GLFW_KEY_DELETE, "Delete", "Delete"},
    {GLFW_KEY_RIGHT, "Right", "Right"},
    {GLFW_KEY_LEFT, "Left", "Left"},
    {GLFW_KEY_DOWN, "Down", "Down"},
    {GLFW_KEY_UP, "Up", "Up"},
    {GLFW_KEY_PAGE_UP, "PageUp", "PageUp"},
    {GLFW_KEY_PAGE_DOWN, "PageDown", "PageDown"},
    {GLFW_KEY_HOME, "Home", "Home"},
    {GLFW_KEY_END, "End", "End"},
    {GLFW_KEY_CAPS_LOCK, "CapsLock", "CapsLock"},
    {GLFW_KEY_SCROLL_LOCK, "ScrollLock", "ScrollLock"},
    {GLFW_KEY_NUM_LOCK, "NumLock", "NumLock"},
    {GLFW_KEY_PRINT_SCREEN, "PrintScreen", "PrintScreen"},
    {GLFW_KEY_PAUSE, "Pause", "Pause"},
    {GLFW_KEY_KP_DECIMAL, "KeypadDecimal", "Keypad ."},
    {GLFW_KEY_KP_DIVIDE, "KeypadDivide", "Keypad /"},
    {GLFW_KEY_KP_MULTIPLY, "KeypadMultiply", "Keypad *"},
    {GLFW_KEY_KP_SUBTRACT, "KeypadSubtract", "Keypad -"},
    {GLFW_KEY_KP_ADD, "KeypadAdd", "Keypad +"},
    {GLFW_KEY_KP_ENTER, "KeypadEnter", "Keypad Enter"},
    {GLFW_KEY_KP_EQUAL, "KeypadEqual", "Keypad ="},
    {GLFW_KEY_LEFT_SHIFT, "LeftShift", "Shift"},
    {GLFW_KEY_LEFT_CONTROL, "LeftCtrl", "Ctrl"},
    {GLFW_KEY_LEFT_ALT, "LeftAlt", "Alt"},
    {GLFW_KEY_LEFT_SUPER, "LeftSuper", "Super"},
    {GLFW_KEY_RIGHT_SHIFT, "RightShift", "right Shift"},
    {GLFW_KEY_RIGHT_CONTROL, "RightCtrl", "right Ctrl"},
    {GLFW_KEY_RIGHT_ALT, "RightAlt", "right Alt"},
    {GLFW_KEY_RIGHT_SUPER, "RightSuper", "right Super"},
    {GLFW_KEY_MENU, "Menu", "Menu"},
};

//! In the order of PadButton: name, and what is printed on the pads of two makers.
constexpr std::array<std::pair<const char*, const char*>, pad_button_count> pad_buttons = {{
    {"south", "A / Cross"},
    {"east", "B / Circle"},
    {"west", "X / Square"},
    {"north", "Y / Triangle"},
    {"left_shoulder", "LB / L1"},
    {"right_shoulder", "RB / R1"},
    {"left_trigger_button", "LT / L2"},
    {"right_trigger_button", "RT / R2"},
    {"select", "View / Share"},
    {"start", "Menu / Options"},
    {"guide", "Guide / PS"},
    {"left_stick", "left stick pressed"},
    {"right_stick", "right stick pressed"},
    {"dpad_up", "D-pad up"},
    {"dpad_down", "D-pad down"},
    {"dpad_left", "D-pad left"},
    {"dpad_right", "D-pad right"},
    {"capture", "Capture"},
    {"touch", "touch pad"},
    {"paddle_1", "paddle 1"},
    {"paddle_2", "paddle 2"},
    {"paddle_3", "paddle 3"},
    {"paddle_4", "paddle 4"},
}};

//! In the order of PadAxis.
constexpr std::array<std::pair<const char*, const char*>, pad_axis_count> pad_axes = {{
    {"left_x", "left stick sideways"},
    {"left_y", "left stick up, down"},
    {"right_x", "right stick sideways"},
    {"right_y", "right stick up, down"},
    {"left_trigger", "LT / L2"},
    {"right_trigger", "RT / R2"},
    {"move_right", "puck sideways"},
    {"move_up", "puck up, down"},
    {"move_forward", "puck forwards, back"},
    {"turn_pitch", "puck tilted forwards, back"},
    {"turn_yaw", "puck turned"},
    {"turn_roll", "puck tilted sideways"},
}};

std::vector<Named> make_table() {
  std::vector<Named> table;
  const auto add = [&](Input::Kind kind, int code, const std::string& name, const std::string& label) {
    table.push_back({kind, code, name, label});
  };
  for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; ++key) {
    add(Input::Kind::key, key, std::string(1, static_cast<char>(key)), std::string(1, static_cast<char>(key)));
  }
  for (int i = 0; i < 10; ++i) {
    const std::string digit(1, static_cast<char>('0' + i));
    add(Input::Kind::key, GLFW_KEY_0 + i, digit, digit);
    add(Input::Kind::key, GLFW_KEY_KP_0 + i, std::string("Keypad").append(digit), std::string("Keypad ").append(digit));
  }
  for (int i = 0; i < 25; ++i) {
    const std::string name = std::string("F").append(std::to_string(i + 1));
    add(Input::Kind::key, GLFW_KEY_F1 + i, name, name);
  }
  for (const NamedKey& key : special_keys) {
    add(Input::Kind::key, key.key, key.name, key.label);
  }
  constexpr const char* mouse[] = {"left", "right", "middle", "4", "5", "6", "7", "8"};
  for (int i = 0; i < 8; ++i) {
    add(Input::Kind::mouse_button, i, std::string("mouse.").append(mouse[i]), std::string("mouse ").append(mouse[i]));
  }
  add(Input::Kind::mouse_axis, 0, "mouse.x", "mouse drag sideways");
  add(Input::Kind::mouse_axis, 1, "mouse.y", "mouse drag up, down");
  add(Input::Kind::wheel, 0, "wheel", "wheel");
  add(Input::Kind::wheel_step, 1, "wheel.up", "wheel up");
  add(Input::Kind::wheel_step, -1, "wheel.down", "wheel down");
  for (std::size_t i = 0; i < pad_buttons.size(); ++i) {
    add(Input::Kind::pad_button, static_cast<int>(i), std::string("pad.").append(pad_buttons[i].first),
        pad_buttons[i].second);
  }
  for (std::size_t i = 0; i < pad_axes.size(); ++i) {
    add(Input::Kind::pad_axis, static_cast<int>(i), std::string("pad.").append(pad_axes[i].first), pad_axes[i].second);
  }
  return table;
}

const std::vector<Named>& table() {
  static const std::vector<Named> made = make_table();
  return made;
}

constexpr std::array<std::pair<const char*, unsigned>, 3> modifiers = {
    {{"Ctrl+", ctrl_held}, {"Alt+", alt_held}, {"Shift+", shift_held}}};

std::string modifier_names(unsigned held) {
  std::string names;
  for (const auto& [name, bit] : modifiers) {
    names += (held & bit) != 0 ? name : "";
  }
  return names;
}

const Named* find(const Input& input) {
  const auto found = std::ranges::find_if(
      table(), [&](const Named& each) { return each.kind == input.kind && each.code == input.code; });
  return found == table().end() ? nullptr : &*found;
}

}  // namespace

std::optional<Input> input_of(std::string_view name) {
  unsigned held = 0;
  for (bool more = true; more;) {
    more = false;
    for (const auto& [prefix, bit] : modifiers) {
      if (name.starts_with(prefix) && (held & bit) == 0) {
        held |= bit;
        name.remove_prefix(std::string_view(prefix).size());
        more = true;
      }
    }
  }
  const auto found = std::ranges::find_if(table(), [&](const Named& each) { return each.name == name; });
  if (found == table().end() || (held != 0 && found->kind != Input::Kind::key)) {
    return std::nullopt;
  }
  return Input{found->kind, found->code, held};
}

std::string name_of(const Input& input) {
  const Named* named = find(input);
  return modifier_names(input.modifiers) + (named != nullptr ? named->name : std::string("?"));
}

std::string label_of(const Input& input) {
  const Named* named = find(input);
  return modifier_names(input.modifiers) + (named != nullptr ? named->label : std::string("?"));
}

const std::vector<std::string>& input_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    all.reserve(table().size());
    for (const Named& each : table()) {
      all.push_back(each.name);
    }
    return all;
  }();
  return names;
}

unsigned modifier_of(int key) {
  switch (key) {
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
      return shift_held;
    case GLFW_KEY_LEFT_CONTROL:
    case GLFW_KEY_RIGHT_CONTROL:
      return ctrl_held;
    case GLFW_KEY_LEFT_ALT:
    case GLFW_KEY_RIGHT_ALT:
      return alt_held;
    default:
      return 0;
  }
}

}  // namespace ergodome
