#include "app/navigation/controls/input_names.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/pads/state/pad_state.h"

namespace ergodome {

namespace {

struct Named {
  Input::Kind kind;
  int code;
  std::string name;
  std::string label;
  std::string german;
};

struct NamedKey {
  int key;
  const char* name;
  const char* label;
  const char* german = nullptr;  //!< label on DIN 2137 keyboards; null: the same
};

//! A button or axis of a controller.
struct NamedPart {
  const char* name;
  const char* label;
  const char* german = nullptr;  //!< German label; null: the same as the English one
};

constexpr NamedKey special_keys[] = {
    {GLFW_KEY_SPACE, "Space", "Space", "Leertaste"},
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
    {GLFW_KEY_ENTER, "Enter", "Enter", "Eingabe"},
    {GLFW_KEY_TAB, "Tab", "Tab"},
    {GLFW_KEY_BACKSPACE, "Backspace", "Backspace", "Rücktaste"},
    {GLFW_KEY_INSERT, "Insert", "Insert", "Einfg"},
    {GLFW_KEY_DELETE, "Delete", "Delete", "Entf"},
    {GLFW_KEY_RIGHT, "Right", "Right", "Rechts"},
    {GLFW_KEY_LEFT, "Left", "Left", "Links"},
    {GLFW_KEY_DOWN, "Down", "Down", "Unten"},
    {GLFW_KEY_UP, "Up", "Up", "Oben"},
    {GLFW_KEY_PAGE_UP, "PageUp", "PageUp", "Bild auf"},
    {GLFW_KEY_PAGE_DOWN, "PageDown", "PageDown", "Bild ab"},
    {GLFW_KEY_HOME, "Home", "Home", "Pos1"},
    {GLFW_KEY_END, "End", "End", "Ende"},
    {GLFW_KEY_CAPS_LOCK, "CapsLock", "CapsLock", "Feststelltaste"},
    {GLFW_KEY_SCROLL_LOCK, "ScrollLock", "ScrollLock", "Rollen"},
    {GLFW_KEY_NUM_LOCK, "NumLock", "NumLock", "Num-Feststelltaste"},
    {GLFW_KEY_PRINT_SCREEN, "PrintScreen", "PrintScreen", "Druck"},
    {GLFW_KEY_PAUSE, "Pause", "Pause"},
    {GLFW_KEY_KP_DECIMAL, "KeypadDecimal", "Keypad .", "Num ,"},
    {GLFW_KEY_KP_DIVIDE, "KeypadDivide", "Keypad /", "Num /"},
    {GLFW_KEY_KP_MULTIPLY, "KeypadMultiply", "Keypad *", "Num *"},
    {GLFW_KEY_KP_SUBTRACT, "KeypadSubtract", "Keypad -", "Num -"},
    {GLFW_KEY_KP_ADD, "KeypadAdd", "Keypad +", "Num +"},
    {GLFW_KEY_KP_ENTER, "KeypadEnter", "Keypad Enter", "Num Eingabe"},
    {GLFW_KEY_KP_EQUAL, "KeypadEqual", "Keypad =", "Num ="},
    {GLFW_KEY_LEFT_SHIFT, "LeftShift", "Shift", "Umschalt"},
    {GLFW_KEY_LEFT_CONTROL, "LeftCtrl", "Ctrl", "Strg"},
    {GLFW_KEY_LEFT_ALT, "LeftAlt", "Alt"},
    {GLFW_KEY_LEFT_SUPER, "LeftSuper", "Super"},
    {GLFW_KEY_RIGHT_SHIFT, "RightShift", "right Shift", "Umschalt rechts"},
    {GLFW_KEY_RIGHT_CONTROL, "RightCtrl", "right Ctrl", "Strg rechts"},
    {GLFW_KEY_RIGHT_ALT, "RightAlt", "right Alt", "AltGr"},
    {GLFW_KEY_RIGHT_SUPER, "RightSuper", "right Super", "Super rechts"},
    {GLFW_KEY_MENU, "Menu", "Menu", "Menü"},
};

//! Names in files, and labels on the controllers of Microsoft and Sony ("A / Cross"), in the order
//! of PadButton.
constexpr std::array<NamedPart, pad_button_count> pad_buttons = {{
    {"south", "A / Cross", "A / Kreuz"},
    {"east", "B / Circle", "B / Kreis"},
    {"west", "X / Square", "X / Quadrat"},
    {"north", "Y / Triangle", "Y / Dreieck"},
    {"left_shoulder", "LB / L1"},
    {"right_shoulder", "RB / R1"},
    {"left_trigger_button", "LT / L2"},
    {"right_trigger_button", "RT / R2"},
    {"select", "View / Share"},
    {"start", "Menu / Options"},
    {"guide", "Guide / PS"},
    {"left_stick", "left stick pressed", "linker Stick gedrückt"},
    {"right_stick", "right stick pressed", "rechter Stick gedrückt"},
    {"dpad_up", "D-pad up", "Steuerkreuz oben"},
    {"dpad_down", "D-pad down", "Steuerkreuz unten"},
    {"dpad_left", "D-pad left", "Steuerkreuz links"},
    {"dpad_right", "D-pad right", "Steuerkreuz rechts"},
    {"capture", "Capture"},
    {"touch", "touch pad", "Touchpad"},
    {"paddle_1", "paddle 1", "Paddel 1"},
    {"paddle_2", "paddle 2", "Paddel 2"},
    {"paddle_3", "paddle 3", "Paddel 3"},
    {"paddle_4", "paddle 4", "Paddel 4"},
}};

//! Names and labels in the order of PadAxis.
constexpr std::array<NamedPart, pad_axis_count> pad_axes = {{
    {"left_x", "left stick sideways", "linker Stick seitwärts"},
    {"left_y", "left stick up, down", "linker Stick auf, ab"},
    {"right_x", "right stick sideways", "rechter Stick seitwärts"},
    {"right_y", "right stick up, down", "rechter Stick auf, ab"},
    {"left_trigger", "LT / L2"},
    {"right_trigger", "RT / R2"},
    {"move_right", "puck sideways", "Kappe seitwärts"},
    {"move_up", "puck up, down", "Kappe auf, ab"},
    {"move_forward", "puck forward, back", "Kappe vor, zurück"},
    {"turn_pitch", "puck tilted forward, back", "Kappe vor, zurück geneigt"},
    {"turn_yaw", "puck turned", "Kappe gedreht"},
    {"turn_roll", "puck tilted sideways", "Kappe seitwärts geneigt"},
}};

std::vector<Named> make_table() {
  std::vector<Named> table;
  const auto add = [&](Input::Kind kind, int code, const std::string& name, const std::string& label,
                       const std::string& german) {
    table.push_back({kind, code, name, label, german});
  };
  const auto add_same = [&](Input::Kind kind, int code, const std::string& name) { add(kind, code, name, name, name); };
  const auto or_same = [](const char* german, const char* label) { return german != nullptr ? german : label; };
  for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; ++key) {
    add_same(Input::Kind::key, key, std::string(1, static_cast<char>(key)));
  }
  for (int i = 0; i < 10; ++i) {
    const std::string digit(1, static_cast<char>('0' + i));
    add_same(Input::Kind::key, GLFW_KEY_0 + i, digit);
    add(Input::Kind::key, GLFW_KEY_KP_0 + i, "Keypad" + digit, "Keypad " + digit, "Num " + digit);
  }
  for (int i = 0; i < 25; ++i) {
    add_same(Input::Kind::key, GLFW_KEY_F1 + i, std::string("F").append(std::to_string(i + 1)));
  }
  for (const NamedKey& key : special_keys) {
    add(Input::Kind::key, key.key, key.name, key.label, or_same(key.german, key.label));
  }
  constexpr const char* mouse[] = {"left", "right", "middle", "4", "5", "6", "7", "8"};
  constexpr const char* german_mouse[] = {"links", "rechts", "Mitte", "4", "5", "6", "7", "8"};
  for (int i = 0; i < 8; ++i) {
    add(Input::Kind::mouse_button, i, std::string("mouse.").append(mouse[i]), std::string("mouse ").append(mouse[i]),
        std::string("Maus ").append(german_mouse[i]));
  }
  add(Input::Kind::mouse_axis, 0, "mouse.x", "mouse drag sideways", "Maus quer ziehen");
  add(Input::Kind::mouse_axis, 1, "mouse.y", "mouse drag up, down", "Maus auf, ab ziehen");
  add(Input::Kind::wheel, 0, "wheel", "wheel", "Mausrad");
  add(Input::Kind::wheel_step, 1, "wheel.up", "wheel up", "Mausrad auf");
  add(Input::Kind::wheel_step, -1, "wheel.down", "wheel down", "Mausrad ab");
  for (std::size_t i = 0; i < pad_buttons.size(); ++i) {
    const NamedPart& button = pad_buttons[i];
    add(Input::Kind::pad_button, static_cast<int>(i), std::string("pad.").append(button.name), button.label,
        or_same(button.german, button.label));
  }
  for (std::size_t i = 0; i < pad_axes.size(); ++i) {
    const NamedPart& axis = pad_axes[i];
    add(Input::Kind::pad_axis, static_cast<int>(i), std::string("pad.").append(axis.name), axis.label,
        or_same(axis.german, axis.label));
  }
  return table;
}

const std::vector<Named>& table() {
  static const std::vector<Named> made = make_table();
  return made;
}

using Modifiers = std::array<std::pair<const char*, unsigned>, 3>;
constexpr Modifiers modifiers = {{{"Ctrl+", ctrl_held}, {"Alt+", alt_held}, {"Shift+", shift_held}}};
constexpr Modifiers german_modifiers = {{{"Strg+", ctrl_held}, {"Alt+", alt_held}, {"Umschalt+", shift_held}}};

std::string modifier_names(unsigned held, const Modifiers& called) {
  std::string names;
  for (const auto& [name, bit] : called) {
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
  return modifier_names(input.modifiers, modifiers) + (named != nullptr ? named->name : std::string("?"));
}

std::string label_of(const Input& input, std::string_view language) {
  const Named* named = find(input);
  const bool german = language == "de";
  const std::string held = modifier_names(input.modifiers, german ? german_modifiers : modifiers);
  return held + (named == nullptr ? "?" : german ? named->german : named->label);
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
