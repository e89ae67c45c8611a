#pragma once

#include <spdlog/common.h>
#include <spdlog/sinks/sink.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! A line of the log.
struct LogLine {
  std::uint64_t number = 0;  //!< from 1, consecutive
  std::chrono::system_clock::time_point time;
  spdlog::level::level_enum level = spdlog::level::info;
  std::string text;
};

//! The last lines of the log, for the status page. Limited in number and length of lines.
//! Thread-safe.
class LogRing {
 public:
  static constexpr std::size_t max_bytes = 1000;  //!< per line; longer lines are truncated

  explicit LogRing(std::size_t max_lines = 500) : max_lines_(max_lines) {}

  //! Adds a line. Control characters become spaces, so that each message stays on one line.
  void push(spdlog::level::level_enum level, std::string_view text, std::chrono::system_clock::time_point time);

  //! Returns the lines with higher numbers, oldest first; 0 returns all that are kept.
  [[nodiscard]] std::vector<LogLine> after(std::uint64_t number) const;

 private:
  mutable std::mutex mutex_;
  std::size_t max_lines_;
  std::uint64_t last_ = 0;
  std::deque<LogLine> lines_;
};

//! Makes a sink for spdlog that writes to a ring.
spdlog::sink_ptr log_ring_sink(std::shared_ptr<LogRing> ring);

}  // namespace ergodome
