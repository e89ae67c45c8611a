#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "app/playback/show_time.h"
#include "content/show/show.h"

namespace ergodome {

//! Identifies a version of a file without reading it.
struct FileStamp {
  std::int64_t modified_ns = 0;
  std::int64_t changed_ns = 0;  //!< when its content, name or rights did
  std::int64_t bytes = 0;
  std::uint64_t inode = 0;

  bool operator==(const FileStamp&) const = default;
};

//! Returns nothing if there is no regular file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

//! Watches files by looking at them now and then, and tells when one has become another and then stood still.
//!
//! Editors empty a file and fill it, or take it away before another gets its name: what is told is a state that lasted, longer for a file that is gone, or
//! empty.
class FileWatch {
 public:
  struct Settings {
    std::chrono::nanoseconds look_every = std::chrono::milliseconds(250);
    std::chrono::nanoseconds settle = std::chrono::milliseconds(200);  //!< for which a new version stands still
    std::chrono::nanoseconds gone = std::chrono::seconds(2);           //!< for which a file is missing, or empty
  };

  FileWatch() : FileWatch(Settings{}) {}
  explicit FileWatch(Settings settings) : settings_(settings) {}

  using WallTime = std::chrono::system_clock::time_point;

  //! From now on these files, as they are now; what was changed after `read_at`, when they were read, is still to be told.
  void watch(const std::vector<std::filesystem::path>& paths, WallTime read_at);
  //! Whether a file has changed since it was watched or last told.
  bool changed(MonotonicTime now);

 private:
  struct File {
    std::filesystem::path path;
    std::optional<FileStamp> known;      //!< the version that has been told
    std::optional<FileStamp> seen;       //!< when last looked at
    std::optional<MonotonicTime> since;  //!< the version that was seen has been there
  };
  bool look(File& file, MonotonicTime now) const;

  Settings settings_;
  std::vector<File> files_;
  std::optional<MonotonicTime> looked_at_;
};

//! Reads a running show again after its file, or one of the files it names, has been saved. It reads on a thread of its own:
//! the player goes on drawing, however long a file takes.
class ShowReload {
 public:
  using Loader = std::function<Show(const std::filesystem::path&)>;

  //! A new version of the show, or why the running one stays.
  struct Result {
    std::optional<Show> show;
    std::string problem;
  };

  //! `running` is the show as it was read from `file` at `read_at`. `load` reads and checks a file, on another thread, and
  //! throws where the show cannot be played.
  ShowReload(std::filesystem::path file, const Show& running, FileWatch::WallTime read_at, Loader load,
             FileWatch::Settings settings = {});

  //! Returns what was read since the last call; call it once a frame. Each broken version is reported once.
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

}  // namespace ergodome
