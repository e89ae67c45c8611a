#include <algorithm>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/report_bytes.h"

namespace ergodome {

namespace {

constexpr std::size_t old_length = 9;
//! Minimum length of a report of the new layout: up to the battery level.
constexpr std::size_t min_new_length = 15;
constexpr std::size_t max_new_length = 64;

//! Reads reports in 8BitDo's two layouts; `otherwise_`, if any, reads all others.
class EightBitDo : public PadDecoder {
 public:
  explicit EightBitDo(std::unique_ptr<PadDecoder> otherwise) : otherwise_(std::move(otherwise)) {
    layout_.axes = stick_and_trigger_axes(0, 0x7F, 255, 255);
    if (otherwise_ != nullptr) {
      for (const RawAxis& axis : otherwise_->layout().axes) {
        if (layout_.axes.size() < max_raw_axes) {
          layout_.axes.push_back(axis);
        }
      }
      layout_.numbered = otherwise_->layout().numbered;
    }
  }

  [[nodiscard]] std::string_view model() const override { return "8BitDo"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.size() == old_length) {
      return take_old(report, pad);
    }
    if (report.size() >= min_new_length && report.size() <= max_new_length &&
        (report[0] == 0x04 || report[0] == 0x03 || report[0] == 0x01)) {
      return take_new(report, pad);
    }
    return take_otherwise(report, pad);
  }

 private:
  static void press_face(RawPad& pad, std::uint8_t byte) {
    press_android_face(pad, byte);
    press_bits(pad, byte, {{0x04, PadButton::paddle_2}, {0x20, PadButton::paddle_1}});
  }

  //! Reads a report of the old layout. Order: face buttons, triggers as switches and middle
  //! buttons, hat, sticks.
  PadReport take_old(ReportBytes report, RawPad& pad) const {
    clear(pad);
    press_face(pad, report[0]);
    press_bits(pad, report[1], {{0x01, PadButton::left_trigger}, {0x02, PadButton::right_trigger}});
    press_android_middle(pad, report[1]);
    press_hat(pad, report[2]);
    take_bytes(pad, 0, report, 3, 4);
    pad.values[4] = (report[1] & 0x01) != 0 ? 255 : 0;
    pad.values[5] = (report[1] & 0x02) != 0 ? 255 : 0;
    return PadReport::state;
  }

  //! Reads a report of the new layout. Order: hat, sticks, right and left trigger, face buttons,
  //! middle buttons, two more paddles.
  PadReport take_new(ReportBytes report, RawPad& pad) const {
    clear(pad);
    press_hat(pad, report[1]);
    take_bytes(pad, 0, report, 2, 4);
    pad.values[5] = report[6];
    pad.values[4] = report[7];
    press_face(pad, report[8]);
    press_android_middle(pad, report[9]);
    press_bits(pad, report[10], {{0x01, PadButton::paddle_3}, {0x02, PadButton::paddle_4}});
    return PadReport::state;
  }

  PadReport take_otherwise(ReportBytes report, RawPad& pad) {
    if (otherwise_ == nullptr) {
      return PadReport::refused;
    }
    RawPad other = at_rest(otherwise_->layout());
    const PadReport kind = otherwise_->decode(report, other);
    if (kind == PadReport::changed) {
      std::copy_n(otherwise_->layout().axes.begin(), layout_.axes.size() - own_axes, layout_.axes.begin() + own_axes);
    }
    if (kind == PadReport::state || kind == PadReport::changed) {
      clear(pad);
      pad.buttons = other.buttons;
      pad.numbered = other.numbered;
      for (std::size_t i = own_axes; i < layout_.axes.size(); ++i) {
        pad.values[i] = other.values[i - own_axes];
      }
    }
    return kind;
  }

  //! Resets everything: the kind of report may change, and each omits values of the others.
  void clear(RawPad& pad) const { pad = at_rest(layout_); }

  static constexpr std::size_t own_axes = 6;
  std::unique_ptr<PadDecoder> otherwise_;
  RawLayout layout_;
};

}  // namespace

std::unique_ptr<PadDecoder> make_8bitdo(std::unique_ptr<PadDecoder> otherwise) {
  return std::make_unique<EightBitDo>(std::move(otherwise));
}

}  // namespace ergodome
