#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "app/budget/deadline.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! A time of a show at which pictures are drawn.
struct TimedMoment {
  double time_s = 0.0;
  CameraPose pose{};
};

//! Time of a whole picture, as in MeasuredSetting.
struct PictureTime {
  double fixed_ms = 0.0;
  double pixels_ms = 0.0;
};

//! Estimates the time of whole pictures from pictures of two small sizes. A whole picture of at
//! most 384 px in width is measured itself.
class PictureTimer {
 public:
  //! A picture is only drawn if that is expected to end before `share` of the deadline's time limit
  //! has passed.
  PictureTimer(ShowRenderer& renderer, Deadline& deadline, std::vector<TimedMoment> moments, int whole_px,
               double share);

  //! Returns a time from medians of pictures whose lenses exist; nothing if time ran out before
  //! each size was timed. The budget of `quality` is in pixels of the whole picture.
  [[nodiscard]] std::optional<PictureTime> time(const FrameQuality& quality);

  //! quickest_ms() returns the time of the picture that was drawn fastest, usually a small one, and
  //! quickest_px() its width; NaN and 0 if none was drawn. A picture of the full width takes at
  //! least that long.
  [[nodiscard]] double quickest_ms() const { return quickest_ms_; }
  [[nodiscard]] int quickest_px() const { return quickest_px_; }

  //! Returns the widths of the pictures that time() draws: two small ones, or only the whole one.
  [[nodiscard]] const std::vector<int>& widths_px() const { return widths_px_; }

 private:
  std::optional<double> median_ms(const FrameQuality& quality, int width_px);
  std::optional<double> draw(const TimedMoment& moment, const FrameQuality& quality, int width_px);

  ShowRenderer& renderer_;
  Deadline& deadline_;
  std::vector<TimedMoment> moments_;
  int whole_px_;
  double share_;
  std::vector<int> widths_px_;
  double quickest_ms_ = std::numeric_limits<double>::quiet_NaN();
  int quickest_px_ = 0;
};

}  // namespace ergodome
