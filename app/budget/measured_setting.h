#pragma once

#include <cmath>
#include <limits>

#include "render/frame/show_renderer.h"

namespace ergodome {

//! Settings of a picture, and what they were measured to miss by and to take. What was not measured is no number (NaN).
struct MeasuredSetting {
  FrameQuality quality;  //!< its budget counts in pixels of the whole picture
  //! What directions miss by on the screen for all but one in a hundred, at the moment that is worst [px of the whole picture].
  double error_px = std::numeric_limits<double>::quiet_NaN();
  //! What the lens of a new place takes; 0 where the camera stays at its place.
  double lens_ms = std::numeric_limits<double>::quiet_NaN();
  //! What a picture takes when its lens is there: whatever its size, and by its pixels, for the whole picture.
  double fixed_ms = std::numeric_limits<double>::quiet_NaN();
  double pixels_ms = std::numeric_limits<double>::quiet_NaN();
  //! At which the error was looked at: fewer than all where it was too much at one, or the time was over.
  int moments = 0;

  //! A picture with a share of the whole one's pixels, whose lens is there [ms].
  [[nodiscard]] double picture_ms(double pixel_share = 1.0) const { return fixed_ms + pixel_share * pixels_ms; }
  //! A whole frame with all that it needs [ms].
  [[nodiscard]] double frame_ms() const { return lens_ms + picture_ms(); }
};

//! A setting is within a budget where this share of it is enough: moments that were not measured may be worse than the worst that was, and so
//! may other pixels of the same moments. Beside a spinning hole that was up to 1.8 times as much.
inline constexpr double kept_share = 0.5;

//! Whether an error is within a budget, with the share that is kept for moments that were not measured.
inline bool is_within(double error_px, double budget_px) { return error_px <= kept_share * budget_px; }

}  // namespace ergodome
