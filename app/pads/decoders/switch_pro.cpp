#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/report_bytes.h"

namespace ergodome {

namespace {

constexpr std::size_t switch_simple_length = 12;
//! Minimum length of a full report: up to the sticks; motion data follows.
constexpr std::size_t min_full_length = 12;
//! USB pads its reports to this length; Bluetooth sends 49.
constexpr std::size_t max_full_length = 64;
constexpr std::uint32_t factory_sticks = 0x603D;
constexpr std::uint32_t user_sticks = 0x8010;

//! Two 12-bit numbers in three bytes.
struct Pair {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

Pair pair_at(ReportBytes bytes, std::size_t at) {
  return {bytes[at] | ((bytes[at + 1] & 0x0F) << 8), (bytes[at + 1] >> 4) | (bytes[at + 2] << 4)};
}

//! Rest position of a stick, and distances from it to the upper and lower ends of its range.
struct StickRange {
  Pair centre;
  Pair above;
  Pair below;
};

void set_range(RawAxis& axis, std::int32_t centre, std::int32_t above, std::int32_t below) {
  if (above > 0 && below > 0 && centre - below >= 0 && centre + above <= 0xFFF) {
    axis.minimum = centre - below;
    axis.centre = centre;
    axis.maximum = centre + above;
  }
}

//! Reports of Nintendo: 0x3F simple (Bluetooth, by default), 0x30 full, 0x21 full with an answer,
//! 0x81 answers over USB.
class SwitchPro : public PadDecoder {
 public:
  explicit SwitchPro(HidBus bus) : bus_(bus) {
    // Sticks use about 3/4 of their 12 bits; the controller's calibration has the exact range. In
    // full reports, y of both sticks increases upward.
    layout_.axes = stick_axes(548, 2048, 3548);
    layout_.axes[1].inverted = false;
    layout_.axes[3].inverted = false;
    for (RawAxis& axis : stick_axes(0, 0x8000, 0xFFFF)) {
      axis.name = "simple_" + axis.name;
      layout_.axes.push_back(std::move(axis));
    }
  }

  [[nodiscard]] std::string_view model() const override { return "Switch Pro"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }
  [[nodiscard]] double silent_after_s() const override { return streams_ ? 1.0 : 0.0; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.empty()) {
      return PadReport::refused;
    }
    switch (report[0]) {
      case 0x3F:
        return report.size() == switch_simple_length ? take_simple(report, pad) : PadReport::refused;
      case 0x30:
        return is_full(report) ? take_full(report, pad) : PadReport::refused;
      case 0x21:
        return is_full(report) ? take_answer(report, pad) : PadReport::refused;
      case 0x81:
        return report.size() >= 2 && report.size() <= max_full_length ? PadReport::other : PadReport::refused;
      default:
        return PadReport::refused;
    }
  }

  //! Over USB: handshake, 3 Mbit/s, handshake, no timeout. Then reads the sticks' calibrations and
  //! requests full reports.
  [[nodiscard]] std::vector<PadRequest> mode_switch() const override {
    std::vector<PadRequest> requests;
    if (bus_ == HidBus::usb) {
      for (const std::uint8_t step : std::initializer_list<std::uint8_t>{0x02, 0x03, 0x02, 0x04}) {
        requests.push_back(padded({0x80, step}));
      }
    }
    requests.push_back(subcommand(0, {0x10, 0x3D, 0x60, 0x00, 0x00, 18}));
    requests.push_back(subcommand(1, {0x10, 0x10, 0x80, 0x00, 0x00, 22}));
    requests.push_back(subcommand(2, {0x03, 0x30}));
    return requests;
  }

 private:
  static bool is_full(ReportBytes report) {
    return report.size() >= min_full_length && report.size() <= max_full_length;
  }

  [[nodiscard]] PadRequest padded(std::vector<std::uint8_t> bytes) const {
    bytes.resize(bus_ == HidBus::usb ? 64 : 49);
    return {PadRequest::Kind::write, std::move(bytes)};
  }

  //! Returns output report 0x01: a counter, rumble off, the subcommand.
  [[nodiscard]] PadRequest subcommand(std::uint8_t counter, std::initializer_list<std::uint8_t> command) const {
    std::vector<std::uint8_t> bytes = {0x01, counter, 0x00, 0x01, 0x40, 0x40, 0x00, 0x01, 0x40, 0x40};
    bytes.insert(bytes.end(), command);
    return padded(std::move(bytes));
  }

  //! Centers the four axes from `first` on, which belong to the other kind of report.
  void rest(RawPad& pad, std::size_t first) const {
    for (std::size_t i = first; i < first + 4; ++i) {
      pad.values[i] = layout_.axes[i].centre;
    }
  }

  PadReport take_simple(ReportBytes report, RawPad& pad) {
    pad.buttons.reset();
    press_bits(pad, report[1],
               {{0x01, PadButton::south},
                {0x02, PadButton::east},
                {0x04, PadButton::west},
                {0x08, PadButton::north},
                {0x10, PadButton::left_shoulder},
                {0x20, PadButton::right_shoulder},
                {0x40, PadButton::left_trigger},
                {0x80, PadButton::right_trigger}});
    press_bits(pad, report[2],
               {{0x01, PadButton::select},
                {0x02, PadButton::start},
                {0x04, PadButton::left_stick},
                {0x08, PadButton::right_stick},
                {0x10, PadButton::guide},
                {0x20, PadButton::capture}});
    press_hat(pad, report[3]);
    rest(pad, 0);
    take_words(pad, 4, report, 4, 4);
    return PadReport::state;
  }

  PadReport take_full(ReportBytes report, RawPad& pad) {
    streams_ = true;
    pad.buttons.reset();
    press_bits(pad, report[3],
               {{0x01, PadButton::west},
                {0x02, PadButton::north},
                {0x04, PadButton::south},
                {0x08, PadButton::east},
                {0x40, PadButton::right_shoulder},
                {0x80, PadButton::right_trigger}});
    press_bits(pad, report[4],
               {{0x01, PadButton::select},
                {0x02, PadButton::start},
                {0x04, PadButton::right_stick},
                {0x08, PadButton::left_stick},
                {0x10, PadButton::guide},
                {0x20, PadButton::capture}});
    press_bits(pad, report[5],
               {{0x01, PadButton::dpad_down},
                {0x02, PadButton::dpad_up},
                {0x04, PadButton::dpad_right},
                {0x08, PadButton::dpad_left},
                {0x40, PadButton::left_shoulder},
                {0x80, PadButton::left_trigger}});
    const Pair left = pair_at(report, 6);
    const Pair right = pair_at(report, 9);
    pad.values[0] = left.x;
    pad.values[1] = left.y;
    pad.values[2] = right.x;
    pad.values[3] = right.y;
    rest(pad, 4);
    return PadReport::state;
  }

  //! Reads the state, and from byte 13: acknowledgment, subcommand, address (4), length, data.
  PadReport take_answer(ReportBytes report, RawPad& pad) {
    const PadReport state = take_full(report, pad);
    if (report.size() < 20 || report[14] != 0x10) {
      return state;
    }
    const std::uint32_t address = u16_at(report, 15) | (static_cast<std::uint32_t>(u16_at(report, 17)) << 16U);
    const std::size_t length = report[19];
    if (report.size() < 20 + length) {
      return state;
    }
    const ReportBytes data = report.subspan(20, length);
    if (address == factory_sticks && length >= 18) {
      if (!user_left_) {
        calibrate_left(data);
      }
      if (!user_right_) {
        calibrate_right(data.subspan(9));
      }
      return PadReport::changed;
    }
    if (address == user_sticks && length >= 22) {
      return take_user_calibration(data);
    }
    return state;
  }

  //! Reads the user's calibration: nine bytes per stick after 0xB2 0xA1, if present.
  PadReport take_user_calibration(ReportBytes data) {
    const bool has_left = u16_at(data, 0) == 0xA1B2;
    const bool has_right = u16_at(data, 11) == 0xA1B2;
    if (has_left) {
      calibrate_left(data.subspan(2));
    }
    if (has_right) {
      calibrate_right(data.subspan(13));
    }
    user_left_ = user_left_ || has_left;
    user_right_ = user_right_ || has_right;
    return has_left || has_right ? PadReport::changed : PadReport::state;
  }

  void calibrate_left(ReportBytes data) { calibrate(0, {pair_at(data, 3), pair_at(data, 0), pair_at(data, 6)}); }
  void calibrate_right(ReportBytes data) { calibrate(2, {pair_at(data, 0), pair_at(data, 6), pair_at(data, 3)}); }

  void calibrate(std::size_t first, const StickRange& range) {
    set_range(layout_.axes[first], range.centre.x, range.above.x, range.below.x);
    set_range(layout_.axes[first + 1], range.centre.y, range.above.y, range.below.y);
  }

  HidBus bus_;
  RawLayout layout_;
  bool streams_ = false;
  //! True if the user's calibration of a stick was read, which has priority over the factory's.
  bool user_left_ = false;
  bool user_right_ = false;
};

}  // namespace

std::unique_ptr<PadDecoder> make_switch_pro(HidBus bus) { return std::make_unique<SwitchPro>(bus); }

}  // namespace ergodome
