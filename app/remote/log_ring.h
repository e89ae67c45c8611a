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

struct LogLine {
  std::uint64_t number = 0;  //!< from 1, without gaps
  std::chrono::system_clock::time_point time;
  spdlog::level::level_enum level = spdlog::level::info;
  std::string text;
};

//! The last lines of the log, for people who look on. Bounded in lines and in their length; any thread may use it.
class LogRing {
 public:
  static constexpr std::size_t most_bytes = 1000;  //!< of a line; the rest is cut off

  explicit LogRing(std::size_t most_lines = 500) : most_lines_(most_lines) {}

  //! Control characters become spaces, so that one message stays one line.
  void push(spdlog::level::level_enum level, std::string_view text, std::chrono::system_clock::time_point time);

  //! Lines with numbers above one, oldest first; 0 gives all that are left.
  [[nodiscard]] std::vector<LogLine> after(std::uint64_t number) const;

 private:
  mutable std::mutex mutex_;
  std::size_t most_lines_;
  std::uint64_t last_ = 0;
  std::deque<LogLine> lines_;
};

//! A sink for spdlog that feeds a ring.
spdlog::sink_ptr log_ring_sink(std::shared_ptr<LogRing> ring);

}  // namespace ergodome
