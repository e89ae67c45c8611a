#pragma once

#include <chrono>
#include <string>

#include "app/player/player_session.h"

namespace ergodome {

//! The show file that a flight is written to, again and again, for the case that the program is stopped hard.
class RecordingFile {
 public:
  //! An empty path: nothing is recorded.
  explicit RecordingFile(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] bool wanted() const { return !path_.empty(); }

  //! Once a frame: writes what was flown so far, if that is due. Throws Error where the file cannot be written.
  void keep(const PlayerSession& session);

  //! Writes it now.
  void save(const PlayerSession& session);

 private:
  using Clock = std::chrono::steady_clock;

  std::string path_;
  Clock::time_point saved_{};
};

}  // namespace ergodome
