#pragma once

#include <chrono>
#include <filesystem>

#include "app/player/player_session.h"

namespace ergodome {

//! Writes flights to show files, repeatedly, so that little is lost if the program is killed.
class RecordingFile {
 public:
  enum class Names {
    one,  //!< the file itself; an older one is kept as NAME.bak
    //! A numbered file per flight in the same folder (next_record()); the last thousand are kept.
    numbered
  };

  //! An empty path disables recording.
  RecordingFile(std::filesystem::path path, Names names) : path_(std::move(path)), names_(names) {}

  [[nodiscard]] bool wanted() const { return !path_.empty(); }

  //! Begins another flight.
  void begin();

  //! Calls save() if it is due; called once per frame.
  bool keep(const PlayerSession& session);

  //! Writes the flight so far, if the session records and has flown. Returns whether it was
  //! written. Throws Error if the file cannot be written.
  bool save(const PlayerSession& session);

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path path_;
  Names names_;
  std::filesystem::path written_;  //!< the file of the current flight; empty if there is none yet
  Clock::time_point saved_{};
};

}  // namespace ergodome
