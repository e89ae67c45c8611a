#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/report_bytes.h"

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
    press_hat_and_face(pad, report[4]);
    press_shoulders(pad, report[5]);
    return PadReport::state;
  }

 private:
  RawLayout layout_;
};

}  // namespace

std::unique_ptr<PadDecoder> make_logitech_f310() { return std::make_unique<LogitechF310>(); }

}  // namespace ergodome
