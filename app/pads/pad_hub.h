#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/pads/pad_session.h"

namespace ergodome {

//! The state of a controller in one frame.
struct PadView {
  std::shared_ptr<const PadIdentity> identity;
  //! Lowest free number, from 1, when the controller was opened; 0 if it could not be opened.
  int number = 0;
  bool connected = false;  //!< false: gone since the last snapshot, or could not be opened
  bool absent = false;     //!< a receiver is connected, but its controller is not
  bool stuck = false;      //!< an axis is ignored because it stays deflected without any motion
  //! State after applying the settings; at rest once the controller is gone.
  PadState state;
  PadPresses presses{};        //!< presses of each button since the last snapshot
  double last_report_s = 0.0;  //!< time of the last report, by the hub's clock
  double last_input_s = 0.0;   //!< when the state last changed; minus infinity: never
  long reports = 0;
  long refused = 0;     //!< number of malformed reports
  std::string problem;  //!< why it cannot be read, and what to do; empty: no problem
};

//! The states of all controllers at one instant.
struct PadSnapshot {
  double time_s = 0.0;  //!< time of the snapshot, by the hub's clock
  std::vector<PadView> pads;
  std::string problem;  //!< problem of the controller library; empty: none

  //! Merges all controllers: the strongest value of each axis, and buttons pressed on any.
  [[nodiscard]] PadState merged() const;
  //! Returns how often a button was pressed on any controller since the last snapshot.
  [[nodiscard]] int presses(PadButton button) const;
  //! Returns when any controller's state last changed [s]; minus infinity: never.
  [[nodiscard]] double last_input_s() const;
};

//! Finds, opens and reads controllers on a separate thread. They may come and go at any time. Once
//! the thread runs, no function throws.
class PadHub {
 public:
  //! `now_s` returns seconds from an arbitrary origin; by default, those since construction by the
  //! steady clock.
  explicit PadHub(std::unique_ptr<HidApi> api, PadSettings settings = {}, std::function<double()> now_s = {});
  ~PadHub();
  PadHub(const PadHub&) = delete;
  PadHub& operator=(const PadHub&) = delete;

  //! Starts the thread. Call it once.
  void start();
  void stop();

  //! Runs one iteration of the thread: looks for controllers if a second has passed, reads reports,
  //! publishes. For tests and for commands without a thread. Waits at most `wait_ms` for each
  //! controller's first report.
  void poll(int wait_ms = 0);

  //! Returns the controllers as last published. Resets the presses and forgets controllers that are
  //! gone, so there must be only one reader.
  PadSnapshot snapshot();

  //! Requests other settings. The next poll() switches to them and reopens every controller.
  void use(PadSettings settings);

  //! Returns the sessions of open controllers, for calibration; only without a thread.
  [[nodiscard]] const std::vector<std::unique_ptr<PadSession>>& sessions() const { return sessions_; }

 private:
  void run();
  void rescan(double now_s);
  void find_pads(double now_s);
  void open(const HidDeviceInfo& info, double now_s);
  bool pump(int wait_ms);
  void publish(double now_s);
  void publish_gone(PadSession& session);
  [[nodiscard]] int free_number() const;
  PadView& view_of(const PadSession& session);
  void take_new_settings();
  bool wait(int milliseconds);

  std::unique_ptr<HidApi> api_;
  PadSettings settings_;
  std::function<double()> now_s_;
  std::vector<std::uint8_t> buffer_;
  std::vector<std::unique_ptr<PadSession>> sessions_;
  std::vector<HidDeviceInfo> listed_;
  std::vector<PadView> denied_;
  std::uint64_t mark_ = 0;
  double next_scan_s_ = 0.0;
  std::string problem_;

  mutable std::mutex mutex_;  //!< guards the members below
  std::condition_variable wake_;
  bool stopping_ = false;
  std::vector<PadView> views_;
  std::string shown_problem_;
  double published_s_ = 0.0;
  std::unique_ptr<PadSettings> new_settings_;

  std::thread thread_;
};

//! Returns the identity of a device: name, connection and path as reported, and the decoder's
//! model.
PadIdentity identity_of(const HidDeviceInfo& info, std::string_view model);

//! Returns the message about a controller that may not be opened.
std::string permission_remedy(const HidDeviceInfo& info);

}  // namespace ergodome
