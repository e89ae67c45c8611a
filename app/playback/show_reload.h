#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/playback/clock/show_clock.h"
#include "content/show/show.h"

namespace ergodome {

//! Identifies a version of a file without reading it.
struct FileStamp {
  std::int64_t modified_ns = 0;
  std::int64_t changed_ns = 0;  //!< when its content, name or permissions changed
  std::int64_t bytes = 0;
  std::uint64_t inode = 0;

  bool operator==(const FileStamp&) const = default;
};

//! Returns the stamp of a file; nothing if it is not a regular file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

//! Watches files by polling, and reports when one has changed and then stayed the same for a while.
//!
//! Editors truncate and rewrite a file, or delete it before another gets its name, so only states
//! that last are reported; missing and empty files must last longer.
class FileWatch {
 public:
  struct Settings {
    std::chrono::nanoseconds check_interval = std::chrono::milliseconds(250);
    //! How long a new version must stay unchanged before it is reported.
    std::chrono::nanoseconds settle = std::chrono::milliseconds(200);
    //! How long a file must be missing or empty before that counts as a change.
    std::chrono::nanoseconds gone = std::chrono::seconds(2);
  };

  FileWatch() : FileWatch(Settings{}) {}
  explicit FileWatch(Settings settings) : settings_(settings) {}

  using WallTime = std::chrono::system_clock::time_point;

  //! Watches these files in place of earlier ones. A new file counts as changed if it was changed
  //! after `read_at`, when it was read; a file that was watched already keeps its state.
  void watch(const std::vector<std::filesystem::path>& paths, WallTime read_at);
  //! Checks the files if `check_interval` has passed since the last check. Returns whether one has
  //! changed, and settled, since it was watched or last reported.
  bool changed(MonotonicTime now);

 private:
  struct File {
    std::filesystem::path path;
    std::optional<FileStamp> known;      //!< version that was read or last reported; nothing: none, or a missing file
    std::optional<FileStamp> seen;       //!< version seen when last polled
    std::optional<MonotonicTime> since;  //!< when the seen version appeared
  };
  bool check(File& file, MonotonicTime now) const;

  Settings settings_;
  std::vector<File> files_;
  std::optional<MonotonicTime> checked_;
};

//! Rereads a running show after its file, or one of the files it names, was saved. It reads on a
//! separate thread, so that the player keeps drawing.
class ShowReload {
 public:
  using Loader = std::function<Show(const std::filesystem::path&)>;

  //! A new version of the show, or why the running one is kept.
  struct Result {
    std::optional<Show> show;
    std::string problem;
  };

  //! `running` is the show read from `file` at `read_at`. `load` reads and checks a file, on
  //! another thread, and throws if the show cannot be played.
  ShowReload(std::filesystem::path file, const Show& running, FileWatch::WallTime read_at, Loader load,
             FileWatch::Settings settings = {});

  //! Returns what was read since the last call. Starts reading if a file has changed or after
  //! request(). Call it once per frame. Each broken version is reported once.
  std::optional<Result> poll(MonotonicTime now);
  //! Reads the show again, whether it changed or not; poll() returns the result.
  void request() { requested_ = true; }
  //! Returns whether a version is being read now.
  [[nodiscard]] bool is_reading() const { return reading_.valid(); }

 private:
  void begin();
  Result take();

  std::filesystem::path file_;
  Loader load_;
  FileWatch watch_;
  bool requested_ = false;
  FileWatch::WallTime read_at_;
  std::future<Result> reading_;
};

//! Returns the file that a show was read from.
std::filesystem::path file_of(const Show& show);

//! Returns the show's file and then all files that it names, existing or not, each once.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& file, const Show& show);

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

  //! Returns a version of the running show that was saved since the last call or while the show
  //! waited, or why there is no such version.
  [[nodiscard]] std::optional<ShowReload::Result> poll(MonotonicTime now);
  //! Rereads the running show, even if it has not changed; poll() returns the result.
  void request();

  //! Result of reading a waiting show whose files have changed. Without a problem, the show can be
  //! read, and is loaded when it becomes the running one.
  struct Waiting {
    std::string file;
    std::string problem;  //!< why the show cannot be read; empty: it can be read
  };
  //! Checks the waiting shows; called once per frame. If a show with changed files has just been
  //! read, returns the result; otherwise returns nothing.
  [[nodiscard]] std::optional<Waiting> poll_waiting(MonotonicTime now);

  //! Records that the version read last did not become current, so that its show is read again when
  //! it runs the next time.
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
    //! The last version did not become current, so the show is read again when it runs.
    bool unread = false;
  };
  std::optional<ShowReload::Result> note(std::optional<ShowReload::Result> result);

  FileWatch::Settings settings_;
  std::map<std::filesystem::path, Watched> shows_;  //!< watched shows by their files
  Watched* running_ = nullptr;
};

}  // namespace ergodome
