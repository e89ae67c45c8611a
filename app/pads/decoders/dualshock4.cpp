#include <array>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/sony.h"
#include "app/pads/decoders/sticks.h"

namespace ergodome {

namespace {

constexpr std::size_t dualshock4_usb_length = 64;
constexpr std::size_t dualshock4_simple_length = 10;
//! Lengths of the reports 0x11 to 0x19 over Bluetooth, as in the controller's descriptor: the
//! longer ones have sound after the state.
constexpr std::array<std::size_t, 9> full_lengths = {78, 142, 206, 270, 334, 398, 462, 526, 547};

class DualShock4 : public PadDecoder {
 public:
  explicit DualShock4(HidBus bus) : bus_(bus) { layout_.axes = stick_and_trigger_axes(0, 128, 255, 255); }

  [[nodiscard]] std::string_view model() const override { return "DualShock 4"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }
  [[nodiscard]] double silent_after_s() const override { return streams_ ? 1.0 : 0.0; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.empty()) {
      return PadReport::refused;
    }
    if (report[0] == 0x01 && (report.size() == dualshock4_usb_length || report.size() == dualshock4_simple_length)) {
      const bool is_full = report.size() == dualshock4_usb_length;
      streams_ = streams_ || is_full;
      // A wireless receiver keeps reporting without a controller.
      return is_full && (report[31] & 0x04) != 0 ? PadReport::absent : take(report.subspan(1), pad);
    }
    if (report[0] < 0x11 || report[0] > 0x19 || report.size() != full_lengths[report[0] - 0x11U] ||
        !sony_checksum_holds(report)) {
      return PadReport::refused;
    }
    if ((report[1] & 0x80) == 0) {
      return PadReport::other;  // sound only
    }
    streams_ = true;
    return take(report.subspan(3), pad);
  }

  //! Reading the calibration makes the controller send full reports until it is switched off.
  [[nodiscard]] std::vector<PadRequest> mode_switch() const override {
    if (bus_ != HidBus::bluetooth) {
      return {};
    }
    std::vector<std::uint8_t> calibration(41);
    calibration[0] = 0x05;
    return {{PadRequest::Kind::get_feature, std::move(calibration)}};
  }

 private:
  //! Order, starting with the left stick's x: sticks, hat and face, shoulders, PS and touch,
  //! triggers.
  static PadReport take(ReportBytes data, RawPad& pad) {
    pad.buttons.reset();
    take_bytes(pad, 0, data, 0, 4);
    take_bytes(pad, 4, data, 7, 2);
    press_sony_face(pad, data[4]);
    press_sony_shoulders(pad, data[5]);
    press_bits(pad, data[6], {{0x01, PadButton::guide}, {0x02, PadButton::touch}});
    pull_pressed_triggers(pad, data[5], 4, 5);
    return PadReport::state;
  }

  HidBus bus_;
  RawLayout layout_;
  bool streams_ = false;
};

}  // namespace

std::unique_ptr<PadDecoder> make_dualshock4(HidBus bus) { return std::make_unique<DualShock4>(bus); }

}  // namespace ergodome
