#include "app/player/recording_file.h"

#include "app/player/recording/numbered_records.h"
#include "content/files/atomic_file.h"
#include "content/show/reading/show_reader.h"

namespace ergodome {

namespace {

constexpr std::chrono::seconds interval{10};
constexpr std::size_t max_records = 1000;

}  // namespace

void RecordingFile::begin() {
  written_.clear();
  saved_ = {};
}

bool RecordingFile::keep(const PlayerSession& session) {
  return wanted() && Clock::now() - saved_ > interval && save(session);
}

bool RecordingFile::save(const PlayerSession& session) {
  saved_ = Clock::now();
  const auto flight = wanted() ? session.recorded("Recorded flight") : std::nullopt;
  if (!flight) {
    return false;
  }
  if (!written_.empty()) {
    write_text_atomically(written_, to_toml(*flight));
    return true;
  }
  if (names_ == Names::numbered) {
    // Makes room first, and removes partial files left by a killed program.
    remove_oldest_records(path_, max_records - 1);
    remove_abandoned_files(path_.has_parent_path() ? path_.parent_path() : std::filesystem::path("."));
  }
  const std::filesystem::path file = names_ == Names::numbered ? next_record(path_) : path_;
  std::error_code problem;
  if (std::filesystem::is_regular_file(file, problem)) {
    keep_older(file);
  }
  write_text_atomically(file, to_toml(*flight));
  written_ = file;
  return true;
}

}  // namespace ergodome
