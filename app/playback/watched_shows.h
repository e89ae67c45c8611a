#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/playback/show_reload.h"

namespace ergodome {

//! An eye on the files of all shows that a player has: of the one that runs, whose new versions are taken over, and of those that wait for their
//! scene, so that one which is broken is told before it is wanted.
class WatchedShows {
 public:
  explicit WatchedShows(FileWatch::Settings settings = {}) : settings_(settings) {}

  //! From now on a show's files are looked at; it was read at `read_at`. Nothing changes for one that is watched already.
  void add(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load);
  //! The same, and from now on it is the one that runs.
  void run(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load);

  //! A version of the one that runs which was saved since the last call, or while it waited; or why there is none.
  [[nodiscard]] std::optional<ShowReload::Result> poll(MonotonicTime now);
  //! Reads the running show again, whether it changed or not; poll() returns the result.
  void request();

  //! What became of a show that waits: it can be read, and will be when it runs, or why it cannot.
  struct Waiting {
    std::string file;
    std::string problem;  //!< empty: none
  };
  //! Once a frame. Nothing where no such file has changed.
  [[nodiscard]] std::optional<Waiting> poll_waiting(MonotonicTime now);

  //! The version that was read last did not come to run: it is to be read again when its show runs again.
  void forget_version();
  //! Why the version that was read last cannot be the one that runs.
  void refuse_version(const std::string& problem);

  //! Why a show's files as they are now are not what is shown, or would be: of the one that runs before those that wait; empty where all is well.
  [[nodiscard]] std::string problem() const;

 private:
  struct Watched {
    ShowReload reload;
    std::string problem{};
    bool unread = false;  //!< there is a version that has not come to run
  };
  std::optional<ShowReload::Result> note(std::optional<ShowReload::Result> result);

  FileWatch::Settings settings_;
  std::map<std::filesystem::path, Watched> shows_;  //!< by their files
  Watched* running_ = nullptr;
};

}  // namespace ergodome
