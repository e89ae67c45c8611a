#pragma once

#include <cstdint>

#include "render/frame/show_renderer.h"

namespace ergodome {

//! Errors of a show's frames at random times: 99 % quantiles over the pixels of each frame [px].
struct BudgetCheck {
  int moments = 0;
  double median_px = 0.0;
  double worst_px = 0.0;
  double worst_time_s = 0.0;  //!< show time
};

//! Number of rows to measure per frame, and of pixels in each, enough for a 99 % quantile.
inline constexpr int usual_checked_rows = 96;

//! Measures the lenses of frames of `size_px` (0: the show's) at random times of the show that the
//! renderer was made for, against rays in closed form. The same seed gives the same times and
//! pixels on every machine. `rows` is the number of rows to measure, and of pixels in each.
BudgetCheck check_error(ShowRenderer& renderer, const Show& show, const FrameQuality& quality, int size_px, int moments,
                        std::uint64_t seed, int rows = usual_checked_rows);

}  // namespace ergodome
