#include "app/remote/common/log_ring.h"

#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>

#include <algorithm>

#include "content/files/printable.h"

namespace ergodome {

namespace {

//! The ring has its own lock, so the sink needs none.
class RingSink : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit RingSink(std::shared_ptr<LogRing> ring) : ring_(std::move(ring)) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    ring_->push(message.level, {message.payload.data(), message.payload.size()},
                std::chrono::time_point_cast<std::chrono::system_clock::duration>(message.time));
  }
  void flush_() override {}

 private:
  std::shared_ptr<LogRing> ring_;
};

}  // namespace

void LogRing::push(spdlog::level::level_enum level, std::string_view text, std::chrono::system_clock::time_point time) {
  std::string line(shortened(text, max_bytes));
  std::replace_if(
      line.begin(), line.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7F;
      },
      ' ');
  const std::lock_guard lock(mutex_);
  lines_.push_back({++last_, time, level, std::move(line)});
  if (lines_.size() > max_lines_) {
    lines_.pop_front();
  }
}

std::vector<LogLine> LogRing::after(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  const auto first =
      std::find_if(lines_.begin(), lines_.end(), [&](const LogLine& line) { return line.number > number; });
  return {first, lines_.end()};
}

spdlog::sink_ptr log_ring_sink(std::shared_ptr<LogRing> ring) { return std::make_shared<RingSink>(std::move(ring)); }

}  // namespace ergodome
