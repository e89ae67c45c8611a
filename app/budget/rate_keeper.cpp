#include "app/budget/rate_keeper.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ergodome {

namespace {

//! Number of frames for the median of drawing times, and for the median that detects frames that
//! are far too slow.
constexpr std::size_t median_frames = 9;
constexpr std::size_t few_frames = 3;
//! Maximum median drawing times, as shares of the frame time: of the last `median_frames`, which
//! leaves time for the window and for slower frames, and of the last `few_frames`.
constexpr double max_work = 0.85;
constexpr double far_too_much_work = 1.5;
//! The next finer rung is tried once its drawing time has been predicted to be less than this share
//! of the frame time for long enough. Until then, the rung stays.
constexpr double work_to_try = 0.65;
//! If the mean interval between frames exceeds the frame time by this factor, frames count as too
//! slow even if drawing alone would fit. Exception: if drawing takes less than the share
//! `work_of_the_window`, the window itself is slow, and no rung helps.
constexpr double late_interval = 1.04;
constexpr double work_of_the_window = 0.5;
constexpr std::size_t interval_frames = 30;
//! Seconds of fast frames before a finer rung is tried: initial value and maximum.
constexpr double first_patience_s = 1.0;
constexpr double max_patience_s = 60.0;
//! Seconds on a rung after a step up to it, after which it counts as fast enough.
constexpr double proof_s = 2.0;
//! Assumed ratio of the time of the next finer rung to the current one's, if either is unknown.
constexpr double unknown_ratio = 1.5;

long frames_in(double seconds, double frame_ms) {
  return std::max(static_cast<long>(std::lround(1000.0 * seconds / frame_ms)), 3L);
}

double median_of_last(const std::deque<double>& values, std::size_t count) {
  std::vector<double> last(values.end() - static_cast<std::ptrdiff_t>(std::min(count, values.size())), values.end());
  const auto middle = last.begin() + static_cast<std::ptrdiff_t>(last.size() / 2);
  std::nth_element(last.begin(), middle, last.end());
  return *middle;
}

//! Returns the mean of the values without the largest tenth of them.
double mean_but_spikes(const std::deque<double>& values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.resize(sorted.size() - sorted.size() / 10);
  return std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
}

void keep_last(std::deque<double>& values, double value, std::size_t maximum) {
  values.push_back(value);
  if (values.size() > maximum) {
    values.pop_front();
  }
}

}  // namespace

RateKeeper::RateKeeper(std::vector<double> rung_ms, double frame_ms, std::size_t first)
    : rung_ms_(std::move(rung_ms)),
      frame_ms_(frame_ms),
      rung_(std::min(first, rung_ms_.empty() ? 0 : rung_ms_.size() - 1)),
      patience_(frames_in(first_patience_s, frame_ms)) {}

void RateKeeper::note(double work_ms, double interval_ms) {
  ++frames_here_;
  if (frames_here_ == 1) {
    return;  // The first frame of a rung also prepares data for later ones.
  }
  keep_last(work_ms_, work_ms, median_frames);
  keep_last(interval_ms_, interval_ms, interval_frames);
  if (is_too_slow()) {
    step_down();
    return;
  }
  if (trying_ && frames_here_ > frames_in(proof_s, frame_ms_)) {
    trying_ = false;
    patience_ = std::max(patience_ / 2, frames_in(first_patience_s, frame_ms_));
  }
  frames_quick_ = finer_would_fit() ? frames_quick_ + 1 : 0;
  if (frames_quick_ > patience_) {
    step_up();
  }
}

bool RateKeeper::is_too_slow() const {
  if (work_ms_.size() >= few_frames && median_of_last(work_ms_, few_frames) > far_too_much_work * frame_ms_) {
    return true;
  }
  if (work_ms_.size() < median_frames) {
    return false;
  }
  const double work_ms = median_of_last(work_ms_, median_frames);
  const double mean_ms = mean_but_spikes(interval_ms_);
  const bool late = interval_ms_.size() == interval_frames && mean_ms > late_interval * frame_ms_;
  return work_ms > max_work * frame_ms_ || (late && work_ms > work_of_the_window * frame_ms_);
}

double RateKeeper::finer_ratio() const {
  const double ratio = rung_ms_[rung_ - 1] / rung_ms_[rung_];
  return std::isfinite(ratio) ? std::max(ratio, 1.0) : unknown_ratio;
}

bool RateKeeper::finer_would_fit() const {
  return rung_ > 0 && work_ms_.size() == median_frames &&
         finer_ratio() * median_of_last(work_ms_, median_frames) < work_to_try * frame_ms_;
}

void RateKeeper::use_rung(std::size_t rung) {
  rung_ = rung;
  ++changes_;
  work_ms_.clear();
  interval_ms_.clear();
  frames_here_ = 0;
  frames_quick_ = 0;
}

void RateKeeper::step_down() {
  if (rung_ + 1 >= rung_ms_.size()) {
    return;
  }
  if (trying_) {
    patience_ = std::min(2 * patience_, frames_in(max_patience_s, frame_ms_));
  }
  trying_ = false;
  use_rung(rung_ + 1);
}

void RateKeeper::step_up() {
  trying_ = true;
  use_rung(rung_ - 1);
}

}  // namespace ergodome
