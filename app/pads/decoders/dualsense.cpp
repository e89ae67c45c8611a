#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/sony.h"
#include "app/pads/decoders/sticks.h"

namespace ergodome {

namespace {

constexpr std::size_t usb_length = 64;
constexpr std::size_t simple_length = 10;
constexpr std::size_t full_length = 78;

class DualSense : public PadDecoder {
 public:
  explicit DualSense(HidBus bus) : bus_(bus) { layout_.axes = stick_and_trigger_axes(0, 128, 255, 255); }

  [[nodiscard]] std::string_view model() const override { return "DualSense"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }
  [[nodiscard]] double silent_after_s() const override { return streams_ ? 1.0 : 0.0; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.empty()) {
      return PadReport::refused;
    }
    if (report[0] == 0x01 && report.size() == usb_length) {
      streams_ = true;
      return take_full(report.subspan(1), pad);
    }
    if (report[0] == 0x01 && (report.size() == simple_length || report.size() == full_length)) {
      return take_simple(report.subspan(1), pad);
    }
    if (report[0] == 0x31 && report.size() == full_length && sony_checksum_holds(report)) {
      streams_ = true;
      return take_full(report.subspan(2), pad);
    }
    return PadReport::refused;
  }

  //! Reading the pairing information makes the controller send full reports until it is switched
  //! off.
  [[nodiscard]] std::vector<PadRequest> mode_switch() const override {
    if (bus_ != HidBus::bluetooth) {
      return {};
    }
    std::vector<std::uint8_t> pairing(20);
    pairing[0] = 0x09;
    return {{PadRequest::Kind::get_feature, std::move(pairing)}};
  }

 private:
  //! Order: sticks, triggers, a counter, hat and face, shoulders, others.
  static PadReport take_full(ReportBytes data, RawPad& pad) {
    pad.buttons.reset();
    take_bytes(pad, 0, data, 0, 6);
    press_sony_face(pad, data[7]);
    press_sony_shoulders(pad, data[8]);
    press_bits(pad, data[9],
               {{0x01, PadButton::guide},
                {0x02, PadButton::touch},
                {0x04, PadButton::capture},  // mutes the microphone
                {0x10, PadButton::paddle_3},
                {0x20, PadButton::paddle_4},
                {0x40, PadButton::paddle_1},
                {0x80, PadButton::paddle_2}});
    pull_pressed_triggers(pad, data[8], 4, 5);
    return PadReport::state;
  }

  //! Order as in DualShock 4: sticks, hat and face, shoulders, PS and touch, triggers.
  static PadReport take_simple(ReportBytes data, RawPad& pad) {
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

std::unique_ptr<PadDecoder> make_dualsense(HidBus bus) { return std::make_unique<DualSense>(bus); }

}  // namespace ergodome
