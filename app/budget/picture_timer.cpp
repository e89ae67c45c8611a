#include "app/budget/picture_timer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/accuracy/statistics.h"

namespace ergodome {

namespace {

//! Widths of the pictures from which times are extrapolated if the whole picture is wider than
//! both.
constexpr int small_px = 160;
constexpr int larger_px = 384;
constexpr int timed_draws = 2;
//! Angle by which the camera is rotated about the hole's axis between two timed pictures [rad].
constexpr double min_turn = 1e-9;
//! Minimum share of the time of the larger timed picture that is assumed to be proportional to its
//! pixels.
constexpr double min_by_pixels = 0.3;

}  // namespace

PictureTimer::PictureTimer(ShowRenderer& renderer, Deadline& deadline, std::vector<TimedMoment> moments, int whole_px,
                           double share)
    : renderer_(renderer), deadline_(deadline), moments_(std::move(moments)), whole_px_(whole_px), share_(share) {
  if (whole_px > larger_px) {
    widths_px_ = {small_px, larger_px};
  } else {
    widths_px_ = {whole_px};
  }
}

std::optional<PictureTime> PictureTimer::time(const FrameQuality& quality) {
  std::vector<double> times_ms;
  std::vector<double> shares;
  for (const int width_px : widths_px_) {
    const std::optional<double> time_ms = median_ms(quality, width_px);
    if (!time_ms) {
      return std::nullopt;
    }
    times_ms.push_back(*time_ms);
    shares.push_back(std::pow(static_cast<double>(width_px) / whole_px_, 2));
  }
  const double by_pixels_ms = times_ms.back() / shares.back();
  if (times_ms.size() < 2) {
    return PictureTime{0.0, by_pixels_ms};
  }
  // Uses the line through both points (share of the pixels, time). If other load made its slope too
  // small or its offset negative, uses the line through the second point with the nearest allowed
  // slope.
  const double slope_ms = (times_ms[1] - times_ms[0]) / (shares[1] - shares[0]);
  const double pixels_ms = std::clamp(slope_ms, min_by_pixels * by_pixels_ms, by_pixels_ms);
  return PictureTime{times_ms[1] - pixels_ms * shares[1], pixels_ms};
}

std::optional<double> PictureTimer::median_ms(const FrameQuality& quality, int width_px) {
  std::vector<double> times_ms;
  for (const TimedMoment& moment : moments_) {
    for (int round = 0; round <= timed_draws; ++round) {
      // Moves the camera a little about the hole between pictures: a static camera would reuse the
      // stars of the last picture, which a moving one cannot.
      TimedMoment next = moment;
      next.pose.phi += round * min_turn;
      const std::optional<double> time_ms = draw(next, quality, width_px);
      // The first draw builds the lens and allocates memory.
      if (time_ms && round > 0) {
        times_ms.push_back(*time_ms);
      }
    }
  }
  return times_ms.empty() ? std::nullopt : std::optional(spread_of(times_ms).median);
}

std::optional<double> PictureTimer::draw(const TimedMoment& moment, const FrameQuality& quality, int width_px) {
  double time_ms = 0.0;
  const auto work = [&] {
    renderer_.apply(moment.time_s);
    // Scales the budget to the pixels of this size: as an angle it stays that of the whole picture,
    // so that the renderer reuses the lens.
    const double width_share = static_cast<double>(width_px) / whole_px_;
    renderer_.set_quality({width_share * quality.budget_px, quality.lens, quality.filter});
    const Projection projection = make_projection(renderer_.show().view, width_px, 0.0);
    const double begun_s = deadline_.elapsed_s();
    renderer_.render_window(moment.pose, projection, ViewMode::sky, {moment.time_s});
    time_ms = 1000.0 * (deadline_.elapsed_s() - begun_s);
    if (!(time_ms >= quickest_ms_)) {
      quickest_ms_ = time_ms;
      quickest_px_ = width_px;
    }
  };
  const bool small = width_px == small_px;
  constexpr double times_the_pixels = static_cast<double>(larger_px) * larger_px / (small_px * small_px);
  const double expected_s = small ? 0.0 : times_the_pixels * deadline_.longest_s(StartWork::small_picture);
  const StartWork kind = small ? StartWork::small_picture : StartWork::picture;
  return deadline_.run(kind, work, share_, 1.0, expected_s) ? std::optional(time_ms) : std::nullopt;
}

}  // namespace ergodome
