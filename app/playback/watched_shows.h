#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/playback/show_reload.h"

namespace ergodome {

//! Watches the files of all shows of a player: of the running show, whose new versions are loaded,
//! and of those that wait for their scene, so that errors are reported before a show is needed.
class WatchedShows {
 public:
  explicit WatchedShows(FileWatch::Settings settings = {}) : settings_(settings) {}

  //! Watches the files of a show that was read at `read_at`. Does nothing if the show is already
  //! watched.
  void add(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load);
  //! Watches a show's files and makes it the running one.
  void run(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load);

  //! Returns a version of the running show that was saved since the last call or while it waited,
  //! or why there is none.
  [[nodiscard]] std::optional<ShowReload::Result> poll(MonotonicTime now);
  //! Rereads the running show, even if it has not changed; poll() returns the result.
  void request();

  //! Result for a changed show that waits: it can be read, and will be when it runs; or why it
  //! cannot.
  struct Waiting {
    std::string file;
    std::string problem;  //!< empty: none
  };
  //! Checks the waiting shows once per frame. Returns nothing if no file has changed.
  [[nodiscard]] std::optional<Waiting> poll_waiting(MonotonicTime now);

  //! Discards the version that was read last, because it did not become current. It is read again
  //! when its show runs again.
  void forget_version();
  //! Records why the version that was read last cannot become current.
  void refuse_version(const std::string& problem);

  //! Returns why the current files of a show cannot be used; the running show comes before waiting
  //! ones. Empty if there is no problem.
  [[nodiscard]] std::string problem() const;

 private:
  struct Watched {
    ShowReload reload;
    std::string problem{};
    bool unread = false;  //!< there is a version that did not become current
  };
  std::optional<ShowReload::Result> note(std::optional<ShowReload::Result> result);

  FileWatch::Settings settings_;
  std::map<std::filesystem::path, Watched> shows_;  //!< by file
  Watched* running_ = nullptr;
};

}  // namespace ergodome
