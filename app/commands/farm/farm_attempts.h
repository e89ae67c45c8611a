#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ergodome {

//! One attempt at a task, as its script recorded it.
struct Attempt {
  std::string step;
  std::string task;
  std::string host;
  int process = 0;
  std::int64_t began_s = 0;   //!< since 1970
  std::int64_t ended_s = 0;   //!< since 1970; 0 unless it has ended
  std::optional<int> status;  //!< exit status, once it has ended
  std::filesystem::path log;
};

//! Returns the attempts of a run, the oldest first. Ignores incomplete and malformed records.
std::vector<Attempt> read_attempts(const std::filesystem::path& run);

//! Returns the last line of an attempt's log that is not empty; empty if there is none.
std::string last_line_of_log(const Attempt& attempt);

}  // namespace ergodome
