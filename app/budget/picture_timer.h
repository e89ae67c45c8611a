#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "app/budget/deadline.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! A moment of a show at which pictures are drawn.
struct TimedMoment {
  double time_s = 0.0;
  CameraPose pose{};
};

//! What a whole picture takes, as in MeasuredSetting.
struct PictureTime {
  double fixed_ms = 0.0;
  double pixels_ms = 0.0;
};

//! Tells what whole pictures take from those of two small sizes, or of the whole one where that is small.
class PictureTimer {
 public:
  //! `share`: of the deadline, after which nothing is begun.
  PictureTimer(ShowRenderer& renderer, Deadline& deadline, std::vector<TimedMoment> moments, int whole_px,
               double share);

  //! From medians of pictures whose lenses are there; nothing where the time is over. The quality's budget counts in pixels of the whole picture.
  [[nodiscard]] std::optional<PictureTime> time(const FrameQuality& quality);

  //! What the quickest of all pictures took that were drawn, and its width: a whole one takes more. NaN where none was.
  [[nodiscard]] double quickest_ms() const { return quickest_ms_; }
  [[nodiscard]] int quickest_px() const { return quickest_px_; }

  //! Widths of the pictures that are drawn.
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
