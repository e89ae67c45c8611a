#pragma once

#include <functional>
#include <memory>

#include "app/pads/decoders/pad_decoder.h"
#include "app/pads/hid/hid_api.h"
#include "app/pads/pad_response.h"

namespace ergodome {

//! How often each button was pressed.
using PadPresses = std::array<std::uint16_t, pad_button_count>;

//! An open controller: reads its reports, keeps its state and counts presses. Ignores stuck axes
//! and counts a silent controller as at rest. Not thread-safe.
class PadSession {
 public:
  //! For `stuck_after_s` see PadSettings.
  PadSession(PadIdentity identity, std::unique_ptr<HidDevice> device, std::unique_ptr<PadDecoder> decoder,
             const PadProfile& profile, double stuck_after_s, double now_s);

  //! Reads the pending reports, at most `max_reports`, and waits up to `wait_ms` for the first.
  //! Returns their number; -1 if the device is gone. `buffer` is for one report.
  int pump(std::span<std::uint8_t> buffer, const std::function<double()>& now_s, int wait_ms);

  //! Ignores axes that have become stuck, and sets the state to rest if the controller has become
  //! silent. Call it regularly.
  void watch(double now_s);

  //! Resets everything to rest, because the controller is gone.
  void release();

  //! Returns the presses since the last call.
  PadPresses take_presses();

  [[nodiscard]] const std::shared_ptr<const PadIdentity>& identity() const { return identity_; }
  [[nodiscard]] const PadState& state() const { return state_; }
  [[nodiscard]] const RawLayout& layout() const { return decoder_->layout(); }
  [[nodiscard]] const RawPad& raw() const { return raw_; }
  [[nodiscard]] bool stuck() const { return ignored_.any(); }
  [[nodiscard]] bool absent() const { return absent_; }
  [[nodiscard]] double last_report_s() const { return last_report_s_; }
  [[nodiscard]] double last_input_s() const { return last_input_s_; }
  [[nodiscard]] long reports() const { return reports_; }
  [[nodiscard]] long refused() const { return refused_; }

  static constexpr int max_reports = 256;

 private:
  void switch_mode();
  void take(ReportBytes report, double now_s);
  void note_motion(double now_s);
  void update(double now_s);
  bool check_axis(std::size_t axis, double now_s);

  //! The value of a raw axis, and since when it is unchanged.
  struct Still {
    std::int32_t value = 0;
    double since_s = 0.0;
  };

  std::shared_ptr<const PadIdentity> identity_;
  std::unique_ptr<HidDevice> device_;
  std::unique_ptr<PadDecoder> decoder_;
  PadProfile profile_;
  double stuck_after_s_;
  PadResponse response_;
  RawPad raw_;
  PadState state_;
  std::array<Still, max_raw_axes> still_{};
  std::bitset<max_raw_axes> ignored_;
  PadPresses presses_{};
  bool absent_ = false;
  bool silent_ = false;
  double last_report_s_ = 0.0;
  double last_input_s_ = 0.0;
  long reports_ = 0;
  long refused_ = 0;
};

}  // namespace ergodome
