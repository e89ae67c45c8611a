#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/pads/pad_session.h"

namespace ergodome {

//! A pad as a frame sees it.
struct PadView {
  std::shared_ptr<const PadIdentity> identity;
  int number = 0;              //!< from 1; a pad that comes back takes the least that is free
  bool connected = false;      //!< false: gone since the last snapshot, or not to be opened
  bool absent = false;         //!< a receiver without its pad
  bool stuck = false;          //!< an axis is left out because it does not move
  PadState state;              //!< after the settings; at rest once it is gone
  PadPresses presses{};        //!< since the last snapshot
  double last_report_s = 0.0;  //!< of the hub's clock
  double last_input_s = 0.0;   //!< when the state changed last; minus infinity: never
  long reports = 0;
  long refused = 0;     //!< reports that were not understood
  std::string problem;  //!< why it cannot be read, and what to do; empty: nothing is wrong
};

//! All pads at one instant.
struct PadSnapshot {
  double time_s = 0.0;  //!< of the hub's clock
  std::vector<PadView> pads;
  std::string problem;  //!< of the whole library; empty: none

  //! All pads as one: of each axis the strongest, of buttons any.
  [[nodiscard]] PadState merged() const;
  //! How often a button went down on any pad since the last snapshot.
  [[nodiscard]] int presses(PadButton button) const;
  //! When any pad's state changed last [s]; minus infinity: never.
  [[nodiscard]] double last_input_s() const;
};

//! Finds, opens and reads pads on a thread of its own. Pads come and go, and nothing here throws once it runs.
class PadHub {
 public:
  //! `now_s` tells seconds from any beginning; by default those of the steady clock since the hub was made.
  explicit PadHub(std::unique_ptr<HidApi> api, PadSettings settings = {}, std::function<double()> now_s = {});
  ~PadHub();
  PadHub(const PadHub&) = delete;
  PadHub& operator=(const PadHub&) = delete;

  //! Starts the thread; call once.
  void start();
  void stop();

  //! What the thread does over and over: looks for pads once a second, reads, publishes. For tests and for commands without a thread;
  //! waits at most `wait_ms`.
  void poll(int wait_ms = 0);

  //! The pads now. Takes the presses, so it is for one reader.
  PadSnapshot snapshot();

  //! Uses other settings from now on: every pad is opened anew.
  void use(PadSettings settings);

  //! Sessions of open pads, for calibration; only where there is no thread.
  [[nodiscard]] const std::vector<std::unique_ptr<PadSession>>& sessions() const { return sessions_; }

 private:
  void run();
  void rescan(double now_s);
  void look_for_pads(double now_s);
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

  mutable std::mutex mutex_;  //!< of what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  std::vector<PadView> views_;
  std::string shown_problem_;
  double published_s_ = 0.0;
  std::unique_ptr<PadSettings> new_settings_;

  std::thread thread_;
};

//! The controllers that could be read, and how they call themselves: name, connection, path.
PadIdentity identity_of(const HidDeviceInfo& info, std::string_view model);

//! Returns the message about a pad that may not be opened.
std::string permission_remedy(const HidDeviceInfo& info);

}  // namespace ergodome
