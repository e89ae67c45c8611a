#pragma once

#include <cstdint>

#include "render/frame/show_renderer.h"

namespace ergodome {

//! Errors of a show's pictures at random moments: of each, what all but one in a hundred of its pixels keep below [px].
struct BudgetCheck {
  int moments = 0;
  double median_px = 0.0;
  double worst_px = 0.0;
  double worst_time_s = 0.0;  //!< of the show
};

//! Rows of a picture that are looked at, and pixels of each: one in a hundred of them is still many.
inline constexpr int usual_checked_rows = 96;

//! Measures the lens of whole pictures of `size_px` (0: as the show says) with settings, at random moments of a show, which the renderer was made
//! for, against light rays in closed form. The seed means the same moments and pixels everywhere. `rows`: so many are looked at, and as many pixels of each.
BudgetCheck check_error(ShowRenderer& renderer, const Show& show, const FrameQuality& quality, int size_px, int moments,
                        std::uint64_t seed, int rows = usual_checked_rows);

}  // namespace ergodome
