#include <array>

#include "app/pads/decoders/decoders.h"

namespace ergodome {

namespace {

constexpr std::int32_t full_deflection = 350;

//! 3D mice of 3Dconnexion. Axes point to the right, toward the user and down. Rotations follow the
//! right-hand rule about them: nose up is positive; clockwise as seen from behind is negative; to
//! the right is positive.
class SpaceMouse : public PadDecoder {
 public:
  SpaceMouse() {
    const auto add = [&](const char* name, PadAxis axis, bool inverted) {
      layout_.axes.push_back({name, -full_deflection, 0, full_deflection, axis, inverted});
    };
    add("x", PadAxis::move_right, false);
    add("y", PadAxis::move_forward, true);
    add("z", PadAxis::move_up, true);
    add("pitch", PadAxis::turn_pitch, false);
    add("roll", PadAxis::turn_roll, true);
    add("yaw", PadAxis::turn_yaw, false);
  }

  [[nodiscard]] std::string_view model() const override { return "SpaceMouse"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }
  //! Reports arrive continuously while the puck moves, followed by zeros; the timeout applies if
  //! those are lost.
  [[nodiscard]] double silent_after_s() const override { return 0.5; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.empty()) {
      return PadReport::refused;
    }
    switch (report[0]) {
      case 0x01:
        return take_axes(report, 0, pad);
      case 0x02:
        return report.size() == 7 ? take_axes(report, 3, pad) : PadReport::refused;
      case 0x03:
        return take_buttons(report, pad);
      case 0x17:
        // This report has the battery level.
        return report.size() >= 2 && report.size() <= 8 ? PadReport::other : PadReport::refused;
      default:
        return PadReport::refused;
    }
  }

 private:
  //! Reads three axes, or all six of newer models.
  static PadReport take_axes(ReportBytes report, std::size_t first, RawPad& pad) {
    if (report.size() != 7 && report.size() != 13) {
      return PadReport::refused;
    }
    for (std::size_t i = 0; 2 * i + 1 < report.size(); ++i) {
      pad.values[first + i] = i16_at(report, 2 * i + 1);
    }
    return PadReport::state;
  }

  //! Reads the first eight buttons: left, right, then those of larger models in order.
  static PadReport take_buttons(ReportBytes report, RawPad& pad) {
    if (report.size() < 2 || report.size() > 16) {
      return PadReport::refused;
    }
    constexpr std::array buttons = {PadButton::south,  PadButton::east,          PadButton::west,
                                    PadButton::north,  PadButton::left_shoulder, PadButton::right_shoulder,
                                    PadButton::select, PadButton::start};
    pad.buttons.reset();
    for (std::size_t i = 0; i < buttons.size(); ++i) {
      if ((report[1] & (1U << i)) != 0) {
        press(pad, buttons[i]);
      }
    }
    return PadReport::state;
  }

  RawLayout layout_;
};

}  // namespace

std::unique_ptr<PadDecoder> make_space_mouse() { return std::make_unique<SpaceMouse>(); }

}  // namespace ergodome
