#include "app/pads/decoders/generic_mapping.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace ergodome {

namespace {

constexpr std::uint16_t desktop_page = 0x01;
constexpr std::uint16_t joystick = 0x04;
constexpr std::uint16_t game_pad = 0x05;
constexpr std::uint16_t multi_axis = 0x08;

struct NamedUsage {
  HidUsage usage;
  const char* name;
};

// HID Usage Tables 1.4: generic desktop (page 1), simulation (2).
constexpr std::array<NamedUsage, 15> axis_usages = {{{{0x01, 0x30}, "x"},
                                                     {{0x01, 0x31}, "y"},
                                                     {{0x01, 0x32}, "z"},
                                                     {{0x01, 0x33}, "rx"},
                                                     {{0x01, 0x34}, "ry"},
                                                     {{0x01, 0x35}, "rz"},
                                                     {{0x01, 0x36}, "slider"},
                                                     {{0x01, 0x37}, "dial"},
                                                     {{0x01, 0x38}, "wheel"},
                                                     {{0x02, 0xBA}, "rudder"},
                                                     {{0x02, 0xBB}, "throttle"},
                                                     {{0x02, 0xC4}, "accelerator"},
                                                     {{0x02, 0xC5}, "brake"},
                                                     {{0x02, 0xC6}, "clutch"},
                                                     {{0x02, 0xC8}, "steering"}}};

struct ButtonUsage {
  HidUsage usage;
  PadButton button;
};

// Generic desktop: D-pad; consumer (page 12): home, back, record.
constexpr std::array<ButtonUsage, 7> button_usages = {{{{0x01, 0x90}, PadButton::dpad_up},
                                                       {{0x01, 0x91}, PadButton::dpad_down},
                                                       {{0x01, 0x92}, PadButton::dpad_right},
                                                       {{0x01, 0x93}, PadButton::dpad_left},
                                                       {{0x0C, 0x223}, PadButton::guide},
                                                       {{0x0C, 0x224}, PadButton::select},
                                                       {{0x0C, 0xB2}, PadButton::capture}}};

bool has_application(const HidLayout& hid, std::uint16_t usage) {
  return std::find(hid.applications.begin(), hid.applications.end(), HidUsage{desktop_page, usage}) !=
         hid.applications.end();
}

//! Returns whether a game pad reports its triggers as a car's pedals, as Android requires. The
//! buttons of such pads are in Android's order too.
bool has_pedals(const HidLayout& hid) {
  constexpr HidUsage accelerator = {0x02, 0xC4};
  return has_application(hid, game_pad) &&
         std::any_of(hid.fields.begin(), hid.fields.end(),
                     [&](const HidField& field) { return field.usage == accelerator; });
}

class AxisMap {
 public:
  explicit AxisMap(std::vector<RawAxis>& axes) : axes_(axes) {}

  RawAxis* find(std::string_view name) {
    const auto found = std::find_if(axes_.begin(), axes_.end(), [&](const RawAxis& axis) { return axis.name == name; });
    return found == axes_.end() ? nullptr : &*found;
  }

  //! Returns whether all these axes exist and have the same range.
  bool alike(std::initializer_list<std::string_view> names) {
    const RawAxis* const first = find(*names.begin());
    return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
      const RawAxis* const axis = find(name);
      return axis != nullptr && axis->minimum == first->minimum && axis->maximum == first->maximum;
    });
  }

  void move(std::string_view name, PadAxis axis, bool inverted = false) {
    if (RawAxis* const raw = find(name); raw != nullptr) {
      raw->axis = axis;
      raw->inverted = inverted;
    }
  }

 private:
  std::vector<RawAxis>& axes_;
};

void map_puck(AxisMap& map) {
  map.move("x", PadAxis::move_right);
  map.move("y", PadAxis::move_forward, true);
  map.move("z", PadAxis::move_up, true);
  map.move("rx", PadAxis::turn_pitch);
  map.move("ry", PadAxis::turn_roll, true);
  map.move("rz", PadAxis::turn_yaw);
}

//! Maps the right stick, and the remaining axes as triggers. The left stick is already mapped.
void map_pad(AxisMap& map) {
  const bool right_is_z = map.find("z") != nullptr && map.find("rz") != nullptr &&
                          (map.alike({"x", "z", "rz"}) || map.find("rx") == nullptr || map.find("ry") == nullptr);
  map.move(right_is_z ? "z" : "rx", PadAxis::right_x);
  map.move(right_is_z ? "rz" : "ry", PadAxis::right_y, true);
  if (map.find("brake") != nullptr && map.find("accelerator") != nullptr) {
    map.move("brake", PadAxis::left_trigger);
    map.move("accelerator", PadAxis::right_trigger);
  } else if (map.find("rx") != nullptr && map.find("ry") != nullptr && map.find("z") != nullptr &&
             map.find("rz") != nullptr) {
    map.move(right_is_z ? "rx" : "z", PadAxis::left_trigger);
    map.move(right_is_z ? "ry" : "rz", PadAxis::right_trigger);
  }
}

}  // namespace

bool is_pad_usage(const HidUsage& usage) {
  return usage.page == desktop_page &&
         (usage.usage == joystick || usage.usage == game_pad || usage.usage == multi_axis);
}

bool has_pad(const HidLayout& hid) {
  return std::any_of(hid.applications.begin(), hid.applications.end(), is_pad_usage);
}

bool is_puck(const HidLayout& hid) { return has_application(hid, multi_axis); }

const char* generic_axis_name(const HidUsage& usage) {
  const auto* const found =
      std::find_if(axis_usages.begin(), axis_usages.end(), [&](const NamedUsage& axis) { return axis.usage == usage; });
  return found == axis_usages.end() ? nullptr : found->name;
}

std::optional<PadButton> generic_button(const HidUsage& usage) {
  const auto* const found = std::find_if(button_usages.begin(), button_usages.end(),
                                         [&](const ButtonUsage& button) { return button.usage == usage; });
  return found == button_usages.end() ? std::nullopt : std::optional(found->button);
}

void map_generic_axes(const HidLayout& hid, std::vector<RawAxis>& axes) {
  AxisMap map(axes);
  if (is_puck(hid)) {
    map_puck(map);
    return;
  }
  map.move("x", PadAxis::left_x);
  map.move("y", PadAxis::left_y, true);
  if (has_application(hid, game_pad) || map.alike({"x", "y", "z", "rz"}) || map.alike({"x", "y", "rx", "ry"})) {
    map_pad(map);
  } else {
    map.move("rz", PadAxis::right_x);
  }
}

std::vector<std::optional<PadButton>> generic_buttons(const HidLayout& hid, std::size_t count) {
  using enum PadButton;
  // Linux order from BTN_GAMEPAD: A, B, C, X, Y, Z, TL, TR, TL2, TR2, SELECT, START, MODE, THUMBL,
  // THUMBR.
  const std::vector<std::optional<PadButton>> by_kernel = {
      south,        east,          std::nullopt, west,  north, std::nullopt, left_shoulder, right_shoulder,
      left_trigger, right_trigger, select,       start, guide, left_stick,   right_stick};
  // Order of Logitech, Sony and most unbranded controllers.
  const std::vector<std::optional<PadButton>> by_logitech = {
      west,   south, east,       north,       left_shoulder, right_shoulder, left_trigger, right_trigger,
      select, start, left_stick, right_stick, guide,         touch,          capture};
  // Order in which the decoder of 3D mice (space_mouse.cpp) numbers the buttons.
  const std::vector<std::optional<PadButton>> by_puck = {south,         east,           west,   north,
                                                         left_shoulder, right_shoulder, select, start};
  std::vector<std::optional<PadButton>> found = by_logitech;
  if (is_puck(hid)) {
    found = by_puck;
  } else if (has_pedals(hid) && count >= by_kernel.size()) {
    found = by_kernel;
  }
  found.resize(count);
  return found;
}

}  // namespace ergodome
