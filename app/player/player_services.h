#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/exhibit/log_file.h"
#include "app/playback/midi_clock_input.h"
#include "app/playback/playback.h"
#include "app/playback/show_reload.h"
#include "app/playback/sound/audio_player.h"
#include "app/remote/common/log_ring.h"
#include "app/remote/remote_control.h"

namespace ergodome {

//! Options of the services of a running show: remote control, clock, sound and log.
struct ServiceOptions {
  RemoteOptions remote;
  std::string clock = "own";  //!< source of the show time: "own", "mtc", "mtc:PORT" or "osc"
  //! The time code at which the show begins ("01:00:00:00"); empty: midnight.
  std::string clock_start;
  bool sound = true;
  double sound_later_s = 0.0;      //!< delay of the sound [s], which compensates for a slow display
  std::filesystem::path log_file;  //!< log file; empty: none
  bool log_on_terminal = true;
};

//! The services of a running show besides rendering: sound, external clock, remote control, log,
//! and watching its files.
class PlayerServices {
 public:
  //! Throws Error if a port is in use or if a clock's input is missing.
  PlayerServices(const ServiceOptions& options, const Show& show);

  //! Switches to another show, read at `read_at`, and watches its files, to reload it when they
  //! change.
  void set_show(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load);
  //! Also watches the files of a show that waits for its scene.
  void watch(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load) {
    shows_.add(show, read_at, std::move(load));
  }
  //! Plays the soundtrack of another version of the show, which has become current.
  void take_version(const Show& show);
  //! Records that the version read last did not become current, so that its show is read again when
  //! it runs the next time.
  void forget_version() { shows_.forget_version(); }
  //! Records why the version that was read last cannot become current.
  void refuse_version(const std::string& problem) { shows_.refuse_version(problem); }

  //! Makes the session's clock follow the source given in the options.
  void drive(Playback& playback) const { playback.follow(clock_); }

  //! Returns the commands from OSC and the status page since the last call.
  [[nodiscard]] std::vector<TransportCommand> commands();

  //! Synchronizes the sound with the show; called once per frame.
  void follow(const Playback& playback);
  //! Adds the state of the sound, and, unless rendering has a problem, problems of show files or of
  //! the sound.
  void fill(PlayerStatus& status) const;
  void post(PlayerStatus status) { board_.post(std::move(status)); }

  //! Returns where the status page and OSC listen, without the token, so that it may be logged.
  [[nodiscard]] std::string remote_text() const;

  //! Returns the status that was posted last.
  [[nodiscard]] PlayerStatus status() const { return board_.read(); }

  //! Returns a version of the show that was saved since the last call, or why it cannot be read.
  //! `now` reads it even if it has not changed.
  [[nodiscard]] std::optional<ShowReload::Result> reloaded(bool now);
  //! Checks the files of waiting shows and logs the result; called once per frame.
  void report_waiting_shows();

  //! Writes lines to the log, even if they repeat.
  void log_changes(const std::vector<std::string>& lines);

  //! Writes a line to the log unless it is empty or equals that of the last call.
  void report(spdlog::level::level_enum level, const std::string& message);

 private:
  //! Publishes the chapters and languages of a show before the first frame, because commands may
  //! arrive earlier.
  void report_show(const Show& show);

  std::shared_ptr<LogRing> ring_;
  std::shared_ptr<spdlog::logger> log_;
  std::string reported_;
  CommandQueue queue_;
  StatusBoard board_;
  std::shared_ptr<ExternalClock> clock_;  //!< null: the show's own clock
  std::unique_ptr<MidiClockInput> midi_;
  std::unique_ptr<AudioPlayer> sound_;
  WatchedShows shows_;
  std::unique_ptr<RemoteControl> remote_;  //!< declared last, so destroyed first: its threads use the members above
};

}  // namespace ergodome
