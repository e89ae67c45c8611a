#include <algorithm>
#include <array>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/report_bytes.h"

namespace ergodome {

namespace {

constexpr std::size_t xbox_old_length = 16;
//! Lengths of reports in the newer layout [bytes]: of One S with newer firmware, Series X|S, and
//! Elite 2 depending on firmware.
constexpr std::array<std::size_t, 5> new_lengths = {17, 19, 33, 39, 55};

//! Microsoft's controllers over Bluetooth; over USB they are not HID devices. Axes have 16 bits
//! around 0x8000, triggers 10.
class XboxBluetooth : public PadDecoder {
 public:
  explicit XboxBluetooth(bool shares) : shares_(shares) {
    layout_.axes = stick_and_trigger_axes(0, 0x8000, 0xFFFF, 1023);
  }

  [[nodiscard]] std::string_view model() const override { return "Xbox over Bluetooth"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.size() == 2 && report[0] == 0x02) {
      guide_ = (report[1] & 0x01) != 0;
      pad.buttons.set(static_cast<std::size_t>(PadButton::guide), guide_);
      return PadReport::state;
    }
    if (report.size() == 2 && report[0] == 0x04) {
      return PadReport::other;  // battery level
    }
    if (report.empty() || report[0] != 0x01) {
      return PadReport::refused;
    }
    const bool is_new = std::find(new_lengths.begin(), new_lengths.end(), report.size()) != new_lengths.end();
    if (!is_new && report.size() != xbox_old_length) {
      return PadReport::refused;
    }
    pad.buttons.reset();
    take_words(pad, 0, report, 1, 4);
    for (std::size_t trigger = 0; trigger < 2; ++trigger) {
      pad.values[4 + trigger] = u16_at(report, 9 + 2 * trigger) & 0x3FF;
    }
    press_hat(pad, report[13] - 1);
    is_new ? press_new(report, pad) : press_old(report, pad);
    return PadReport::state;
  }

 private:
  void press_old(ReportBytes report, RawPad& pad) const {
    press_bits(pad, report[14],
               {{0x01, PadButton::south},
                {0x02, PadButton::east},
                {0x04, PadButton::west},
                {0x08, PadButton::north},
                {0x10, PadButton::left_shoulder},
                {0x20, PadButton::right_shoulder},
                {0x40, PadButton::select},
                {0x80, PadButton::start}});
    press_bits(pad, report[15], {{0x01, PadButton::left_stick}, {0x02, PadButton::right_stick}});
    pad.buttons.set(static_cast<std::size_t>(PadButton::guide), guide_);
  }

  void press_new(ReportBytes report, RawPad& pad) const {
    press_android_face(pad, report[14]);
    press_android_middle(pad, report[15]);
    press_bits(pad, report[16], {{0x01, shares_ ? PadButton::capture : PadButton::select}});
    if (guide_) {
      press(pad, PadButton::guide);
    }
  }

  bool shares_;
  bool guide_ = false;  //!< whether the guide button is held, which older firmware reports separately
  RawLayout layout_;
};

}  // namespace

std::unique_ptr<PadDecoder> make_xbox_bluetooth(bool shares) { return std::make_unique<XboxBluetooth>(shares); }

}  // namespace ergodome
