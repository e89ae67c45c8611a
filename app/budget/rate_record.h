#pragma once

#include <algorithm>

namespace ergodome {

//! Statistics of the achieved frame rate, over consecutive frames while something moved.
class RateRecord {
 public:
  explicit RateRecord(double frame_ms) : frame_ms_(frame_ms) {}

  void note(double interval_ms) {
    ++frames_;
    sum_ms_ += interval_ms;
    late_ += interval_ms > late_share * frame_ms_ ? 1 : 0;
    longest_ms_ = std::max(longest_ms_, interval_ms);
  }

  [[nodiscard]] long frames() const { return frames_; }
  //! Returns the mean rate [Hz]; 0 before the first frame.
  [[nodiscard]] double rate_hz() const { return frames_ > 0 ? 1000.0 * static_cast<double>(frames_) / sum_ms_ : 0.0; }
  //! Returns the fraction of frames late by at least half a frame time.
  [[nodiscard]] double late() const {
    return frames_ > 0 ? static_cast<double>(late_) / static_cast<double>(frames_) : 0.0;
  }
  [[nodiscard]] double longest_ms() const { return longest_ms_; }

 private:
  static constexpr double late_share = 1.5;

  double frame_ms_;
  long frames_ = 0;
  long late_ = 0;
  double sum_ms_ = 0.0;
  double longest_ms_ = 0.0;
};

}  // namespace ergodome
