#include "app/playback/watched_shows.h"

#include <utility>

namespace ergodome {

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
