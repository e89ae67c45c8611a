#include "app/playback/show_reload.h"

#include <sys/stat.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "content/show/reading/show_files.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

std::int64_t nanoseconds_of(const timespec& time) { return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec; }

std::int64_t nanoseconds_of(FileWatch::WallTime time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

//! Throws Error if a show's file is missing or empty.
void require_version(const std::filesystem::path& file) {
  const auto stamp = stamp_of(file);
  if (!stamp || stamp->bytes == 0) {
    throw Error(file.string(), stamp ? "is empty" : "no longer exists or is not a file",
                "restore it; until then the last version that was read keeps running");
  }
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return std::nullopt;
  }
  return FileStamp{nanoseconds_of(status.st_mtim), nanoseconds_of(status.st_ctim), status.st_size, status.st_ino};
}

void FileWatch::watch(const std::vector<std::filesystem::path>& paths, WallTime read_at) {
  // Time stamps of file systems have a resolution of some milliseconds, so a file that changed
  // shortly before `read_at` also counts as changed.
  const std::int64_t known_ns = nanoseconds_of(read_at - std::chrono::milliseconds(10));
  std::vector<File> files;
  for (const std::filesystem::path& path : paths) {
    const auto before = std::ranges::find(files_, path, &File::path);
    if (before != files_.end()) {
      // Keeps the state of a file that was already watched, so that a change during the reading is
      // still reported.
      files.push_back(*before);
    } else {
      const auto stamp = stamp_of(path);
      const bool known = stamp && stamp->changed_ns < known_ns;
      files.push_back({path, known ? stamp : std::nullopt, stamp, std::nullopt});
    }
  }
  files_ = std::move(files);
}

bool FileWatch::check(File& file, MonotonicTime now) const {
  const auto stamp = stamp_of(file.path);
  if (stamp != file.seen || !file.since) {
    file.seen = stamp;
    file.since = now;
  }
  const bool there = stamp && stamp->bytes > 0;
  if (stamp == file.known || now - *file.since < (there ? settings_.settle : settings_.gone)) {
    return false;
  }
  file.known = stamp;
  return true;
}

bool FileWatch::changed(MonotonicTime now) {
  if (checked_ && now - *checked_ < settings_.check_interval) {
    return false;
  }
  checked_ = now;
  bool any = false;
  for (File& file : files_) {
    any = check(file, now) || any;
  }
  return any;
}

ShowReload::ShowReload(std::filesystem::path file, const Show& running, FileWatch::WallTime read_at, Loader load,
                       FileWatch::Settings settings)
    : file_(std::move(file)), load_(std::move(load)), watch_(settings) {
  watch_.watch(files_of(file_, running), read_at);
}

std::optional<ShowReload::Result> ShowReload::poll(MonotonicTime now) {
  if (reading_.valid()) {
    const bool ready = reading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    return ready ? std::optional(take()) : std::nullopt;
  }
  if (watch_.changed(now) || requested_) {
    begin();
  }
  return std::nullopt;
}

void ShowReload::begin() {
  requested_ = false;
  read_at_ = std::chrono::system_clock::now();
  reading_ = std::async(std::launch::async, [file = file_, load = load_]() -> Result {
    try {
      require_version(file);
      return {load(file), ""};
    } catch (const std::exception& problem) {
      return {std::nullopt, problem.what()};
    }
  });
}

ShowReload::Result ShowReload::take() {
  Result result = reading_.get();
  if (result.show) {
    watch_.watch(files_of(file_, *result.show), read_at_);
  }
  return result;
}

std::filesystem::path file_of(const Show& show) { return std::filesystem::path(show.folder) / (show.name + ".toml"); }

std::vector<std::filesystem::path> files_of(const std::filesystem::path& file, const Show& show) {
  std::vector<std::filesystem::path> files = {file};
  for (const NamedFile& named : files_of_show(show)) {
    const std::filesystem::path path = std::filesystem::path(show.folder) / named.name;
    if (std::ranges::find(files, path) == files.end()) {
      files.push_back(path);
    }
  }
  return files;
}

void WatchedShows::add(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load) {
  const std::filesystem::path file = file_of(show);
  if (!shows_.contains(file)) {
    shows_.emplace(file, Watched{ShowReload(file, show, read_at, std::move(load), settings_)});
  }
}

void WatchedShows::run(const Show& show, FileWatch::WallTime read_at, ShowReload::Loader load) {
  add(show, read_at, std::move(load));
  running_ = &shows_.at(file_of(show));
}

std::optional<ShowReload::Result> WatchedShows::note(std::optional<ShowReload::Result> result) {
  if (result) {
    running_->problem = result->problem;
  }
  return result;
}

std::optional<ShowReload::Result> WatchedShows::poll(MonotonicTime now) {
  if (running_ == nullptr) {
    return std::nullopt;
  }
  if (std::exchange(running_->unread, false)) {
    running_->reload.request();
  }
  return note(running_->reload.poll(now));
}

void WatchedShows::request() {
  if (running_ != nullptr) {
    running_->reload.request();
  }
}

std::optional<WatchedShows::Waiting> WatchedShows::poll_waiting(MonotonicTime now) {
  for (auto& [file, watched] : shows_) {
    if (&watched == running_) {
      continue;
    }
    if (const auto result = watched.reload.poll(now)) {
      watched.problem = result->problem;
      watched.unread = result->show.has_value();
      return Waiting{file.string(), result->problem};
    }
  }
  return std::nullopt;
}

void WatchedShows::forget_version() {
  if (running_ != nullptr) {
    running_->unread = true;
  }
}

void WatchedShows::refuse_version(const std::string& problem) {
  if (running_ != nullptr) {
    running_->problem = problem;
  }
}

std::string WatchedShows::problem() const {
  if (running_ != nullptr && !running_->problem.empty()) {
    return running_->problem;
  }
  for (const auto& [file, watched] : shows_) {
    if (!watched.problem.empty()) {
      return watched.problem;
    }
  }
  return {};
}

}  // namespace ergodome
