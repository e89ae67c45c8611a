#include "app/commands/farm/farm_attempts.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Reads "began TIME STEP TASK PROCESS HOST" and, once the attempt has ended, "ended TIME STATUS".
std::optional<Attempt> read_attempt(const fs::path& file) {
  std::ifstream lines(file);
  Attempt attempt;
  std::string word;
  if (!(lines >> word >> attempt.began_s >> attempt.step >> attempt.task >> attempt.process >> attempt.host) ||
      word != "began") {
    return std::nullopt;
  }
  int status = 0;
  if (lines >> word >> attempt.ended_s >> status && word == "ended") {
    attempt.status = status;
  }
  attempt.log = file;
  attempt.log += ".log";
  return attempt;
}

}  // namespace

std::vector<Attempt> read_attempts(const fs::path& run) {
  std::vector<Attempt> attempts;
  std::error_code problem;
  for (fs::directory_iterator each(run / "attempts", problem), end; !problem && each != end; each.increment(problem)) {
    if (each->path().extension() == ".log") {
      continue;
    }
    if (std::optional<Attempt> attempt = read_attempt(each->path())) {
      attempts.push_back(std::move(*attempt));
    }
  }
  std::ranges::sort(attempts, {}, [](const Attempt& each) { return std::pair(each.began_s, each.log); });
  return attempts;
}

std::string last_line_of_log(const Attempt& attempt) {
  constexpr std::streamoff tail_bytes = 4096;
  std::ifstream file(attempt.log, std::ios::binary | std::ios::ate);
  const std::streamoff end = file.tellg();
  file.seekg(std::max<std::streamoff>(end - tail_bytes, 0));
  std::string last;
  for (std::string line; std::getline(file, line);) {
    last = line.empty() ? last : line;
  }
  return last;
}

}  // namespace ergodome
