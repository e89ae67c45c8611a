#include <array>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/report_bytes.h"

namespace ergodome {

namespace {

constexpr std::size_t sony_usb_length = 64;
constexpr std::size_t sony_simple_length = 10;

//! Common parts of Sony's controllers: two sticks and two triggers of one byte each.
class SonyPad : public PadDecoder {
 public:
  explicit SonyPad(HidBus bus) : bus_(bus) { layout_.axes = stick_and_trigger_axes(0, 128, 255, 255); }

  [[nodiscard]] const RawLayout& layout() const override { return layout_; }
  [[nodiscard]] double silent_after_s() const override { return streams_ ? 1.0 : 0.0; }

 protected:
  //! Records that full reports arrive. The controller sends these continuously, so from now on
  //! silence means that it is gone.
  void note_stream() { streams_ = true; }

  //! Returns the request for a feature report over Bluetooth. Reading it makes the controller send
  //! full reports until it is switched off.
  [[nodiscard]] std::vector<PadRequest> request(std::uint8_t id, std::size_t size) const {
    if (bus_ != HidBus::bluetooth) {
      return {};
    }
    std::vector<std::uint8_t> feature(size);
    feature[0] = id;
    return {{PadRequest::Kind::get_feature, std::move(feature)}};
  }

  //! Returns whether the last four bytes of a Bluetooth report are the CRC-32 of 0xA1 (the
  //! transport header) and all bytes before them.
  static bool checksum_holds(ReportBytes report) {
    const std::size_t end = report.size() - 4;
    const auto stored =
        static_cast<std::uint32_t>(u16_at(report, end)) | (static_cast<std::uint32_t>(u16_at(report, end + 2)) << 16U);
    return crc32_after(0xA1, report.first(end)) == stored;
  }

  //! Reads the state. Order of the bytes, starting with x of the left stick: sticks, hat and face
  //! buttons, shoulder buttons, PS button and touch pad, triggers.
  static PadReport take(ReportBytes data, RawPad& pad) {
    pad.buttons.reset();
    take_bytes(pad, 0, data, 0, 4);
    take_bytes(pad, 4, data, 7, 2);
    press_hat_and_face(pad, data[4]);
    press_shoulders(pad, data[5]);
    press_bits(pad, data[6], {{0x01, PadButton::guide}, {0x02, PadButton::touch}});
    pull_pressed_triggers(pad, data[5]);
    return PadReport::state;
  }

  //! Sets the axis of a pressed trigger to full if it is 0: some controllers have switches as
  //! triggers.
  static void pull_pressed_triggers(RawPad& pad, std::uint8_t shoulders) {
    for (std::size_t trigger = 0; trigger < 2; ++trigger) {
      std::int32_t& value = pad.values[4 + trigger];
      if ((shoulders & (0x04U << trigger)) != 0 && value == 0) {
        value = 255;
      }
    }
  }

 private:
  HidBus bus_;
  RawLayout layout_;
  bool streams_ = false;
};

class DualShock4 : public SonyPad {
 public:
  using SonyPad::SonyPad;

  [[nodiscard]] std::string_view model() const override { return "DualShock 4"; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.empty()) {
      return PadReport::refused;
    }
    if (report[0] == 0x01 && report.size() == sony_usb_length) {
      note_stream();
      // A wireless receiver keeps reporting without a controller.
      return (report[31] & 0x04) != 0 ? PadReport::absent : take(report.subspan(1), pad);
    }
    if (report[0] == 0x01 && report.size() == sony_simple_length) {
      return take(report.subspan(1), pad);
    }
    if (report[0] < 0x11 || report[0] > 0x19 || report.size() != full_lengths[report[0] - 0x11U] ||
        !checksum_holds(report)) {
      return PadReport::refused;
    }
    if ((report[1] & 0x80) == 0) {
      return PadReport::other;  // the report contains only sound
    }
    note_stream();
    return take(report.subspan(3), pad);
  }

  //! Requests the calibration, because reading it switches the controller to full reports over
  //! Bluetooth.
  [[nodiscard]] std::vector<PadRequest> mode_switch() const override { return request(0x05, 41); }

 private:
  //! Lengths of the reports 0x11 to 0x19 over Bluetooth, as in the controller's descriptor: the
  //! longer ones have sound after the state.
  static constexpr std::array<std::size_t, 9> full_lengths = {78, 142, 206, 270, 334, 398, 462, 526, 547};
};

class DualSense : public SonyPad {
 public:
  using SonyPad::SonyPad;

  [[nodiscard]] std::string_view model() const override { return "DualSense"; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    if (report.empty()) {
      return PadReport::refused;
    }
    if (report[0] == 0x01 && report.size() == sony_usb_length) {
      note_stream();
      return take_full(report.subspan(1), pad);
    }
    if (report[0] == 0x01 && (report.size() == sony_simple_length || report.size() == full_length)) {
      return take(report.subspan(1), pad);
    }
    if (report[0] == 0x31 && report.size() == full_length && checksum_holds(report)) {
      note_stream();
      return take_full(report.subspan(2), pad);
    }
    return PadReport::refused;
  }

  //! Requests the pairing information, because reading it switches the controller to full reports
  //! over Bluetooth.
  [[nodiscard]] std::vector<PadRequest> mode_switch() const override { return request(0x09, 20); }

 private:
  static constexpr std::size_t full_length = 78;

  //! Reads a full report. Order of its bytes: sticks, triggers, a counter, hat and face buttons,
  //! shoulder buttons, other buttons.
  static PadReport take_full(ReportBytes data, RawPad& pad) {
    pad.buttons.reset();
    take_bytes(pad, 0, data, 0, 6);
    press_hat_and_face(pad, data[7]);
    press_shoulders(pad, data[8]);
    press_bits(pad, data[9],
               {{0x01, PadButton::guide},
                {0x02, PadButton::touch},
                {0x04, PadButton::capture},  // the button that mutes the microphone
                {0x10, PadButton::paddle_3},
                {0x20, PadButton::paddle_4},
                {0x40, PadButton::paddle_1},
                {0x80, PadButton::paddle_2}});
    pull_pressed_triggers(pad, data[8]);
    return PadReport::state;
  }
};

}  // namespace

std::unique_ptr<PadDecoder> make_dualshock4(HidBus bus) { return std::make_unique<DualShock4>(bus); }

std::unique_ptr<PadDecoder> make_dualsense(HidBus bus) { return std::make_unique<DualSense>(bus); }

}  // namespace ergodome
