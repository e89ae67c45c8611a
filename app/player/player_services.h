#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/exhibit/log_file.h"
#include "app/playback/midi_clock_input.h"
#include "app/playback/playback.h"
#include "app/playback/sound/audio_player.h"
#include "app/playback/watched_shows.h"
#include "app/remote/log_ring.h"
#include "app/remote/remote_control.h"

namespace ergodome {

struct ServiceOptions {
  RemoteOptions remote;
  std::string clock = "own";  //!< "mtc", "mtc:PORT" or "osc": what the show's time follows
  std::string clock_start;    //!< the time code at which the show begins ("01:00:00:00"); empty: midnight
  bool sound = true;
  double sound_later_s = 0.0;      //!< for displays that take their time
  std::filesystem::path log_file;  //!< empty: none
  bool log_on_terminal = true;
};

//! What a running show has beside its pictures: sound, a clock from outside, remote control, a log, and an eye on its file.
class PlayerServices {
 public:
  //! Throws Error where a port is in use or a clock's input is missing.
  PlayerServices(const ServiceOptions& options, const Show& show);

  //! Another show, read at `read_at`: its files are looked at, to be read again when they change.
  void set_show(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load);
  //! The files of a show that waits for its scene are looked at, too.
  void watch(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load) {
    shows_.add(show, read_at, std::move(load));
  }
  //! Another version of the show is the one that runs now.
  void take_version(const Show& show);
  //! The version that was read last did not come to run: it is to be read again when its show runs again.
  void forget_version() { shows_.forget_version(); }
  //! Why the version that was read last cannot be the one that runs.
  void refuse_version(const std::string& problem) { shows_.refuse_version(problem); }

  //! Makes the session's clock follow what the options say.
  void drive(Playback& playback) const { playback.follow(clock_); }

  //! What OSC and the page asked for since the last call.
  [[nodiscard]] std::vector<TransportCommand> commands();

  //! Once a frame: sound goes where the show is.
  void follow(const Playback& playback);
  //! Writes what is known here: sound, and what is wrong with shows' files or with sound where pictures have no problem.
  void fill(PlayerStatus& status) const;
  void post(PlayerStatus status) { board_.post(std::move(status)); }

  //! Where the status page and OSC listen; without the token, so that it may be logged.
  [[nodiscard]] std::string remote_text() const;

  //! What was posted last.
  [[nodiscard]] PlayerStatus status() const { return board_.read(); }

  //! A version of the show's file that was saved since the last call, or why there is none; `now` reads it, changed or not.
  [[nodiscard]] std::optional<ShowReload::Result> reloaded(bool now);
  //! Once a frame: looks at the files of shows that wait, and logs what became of them.
  void look_at_waiting_shows();

  //! Writes lines to the log, whatever was written before.
  void log_changes(const std::vector<std::string>& lines);

  //! Writes a line to the log, unless it is the one that was written last.
  void tell(spdlog::level::level_enum level, const std::string& message);

 private:
  //! Commands of chapters and languages may come before the first picture does.
  void tell_of_the_show(const Show& show);

  std::shared_ptr<LogRing> ring_;
  std::shared_ptr<spdlog::logger> log_;
  std::string told_;
  CommandQueue queue_;
  StatusBoard board_;
  std::shared_ptr<ExternalClock> clock_;  //!< none: the show's own
  std::unique_ptr<MidiClockInput> midi_;
  std::unique_ptr<AudioPlayer> sound_;
  WatchedShows shows_;
  std::unique_ptr<RemoteControl> remote_;  //!< last: its threads use what stands above
};

}  // namespace ergodome
