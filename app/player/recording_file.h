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

  //! Once a frame: writes what was flown so far, if that is due, and says whether it was. Throws Error where the file cannot be written.
  bool keep(const PlayerSession& session);

  //! Writes it now, where the session records and has flown. Throws Error where the file cannot be written.
  void save(const PlayerSession& session);

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path path_;
  Names names_;
  std::filesystem::path written_;  //!< the flight's own file; empty while there is none
  Clock::time_point saved_{};
};

}  // namespace ergodome
