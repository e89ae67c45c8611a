#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/sticks.h"

namespace ergodome {

namespace {

//! Reads the controller with its switch at D; at X it is not a HID device. Reports have eight bytes
//! without an id: sticks, hat and face, shoulders, two vendor bytes.
class LogitechF310 : public PadDecoder {
 public:
  LogitechF310() { layout_.axes = stick_axes(0, 128, 255); }

  [[nodiscard]] std::string_view model() const override { return "Logitech F310"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.size() != 8) {
      return PadReport::refused;
    }
    pad.buttons.reset();
    take_bytes(pad, 0, report, 0, 4);
    press_hat(pad, report[4] & 0x0F);
    press_bits(pad, report[4],
               {{0x10, PadButton::west}, {0x20, PadButton::south}, {0x40, PadButton::east}, {0x80, PadButton::north}});
    press_bits(pad, report[5],
               {{0x01, PadButton::left_shoulder},
                {0x02, PadButton::right_shoulder},
                {0x04, PadButton::left_trigger},
                {0x08, PadButton::right_trigger},
                {0x10, PadButton::select},
                {0x20, PadButton::start},
                {0x40, PadButton::left_stick},
                {0x80, PadButton::right_stick}});
    return PadReport::state;
  }

 private:
  RawLayout layout_;
};

}  // namespace

std::unique_ptr<PadDecoder> make_logitech_f310() { return std::make_unique<LogitechF310>(); }

}  // namespace ergodome
