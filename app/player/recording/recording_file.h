#pragma once

#include <chrono>
#include <filesystem>

#include "app/player/player_session.h"

namespace ergodome {

//! The show files that flights are written to, again and again, for the case that the program is stopped hard.
class RecordingFile {
 public:
  enum class Names {
    one,      //!< the file itself; what is there from before is kept as NAME.bak
    numbered  //!< a file beside it for each flight (next_record()), of which the last thousand are kept
  };

  //! An empty path: nothing is recorded.
  RecordingFile(std::filesystem::path path, Names names) : path_(std::move(path)), names_(names) {}

  [[nodiscard]] bool wanted() const { return !path_.empty(); }

  //! What comes is another flight.
  void begin();

  //! Once a frame: save(), if that is due.
  bool keep(const PlayerSession& session);

  //! Writes what was flown so far, where the session records and has flown, and says whether it was written. Throws Error where the file cannot be.
  bool save(const PlayerSession& session);

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path path_;
  Names names_;
  std::filesystem::path written_;  //!< the flight's own file; empty while there is none
  Clock::time_point saved_{};
};

}  // namespace ergodome
