#pragma once

#include <array>

namespace ergodome {

//! Pixels to one side that a point's light reaches at the most: a spread of 100 px, in a dome that is four times as fine as it was given for.
inline constexpr int widest_splat_px = 1201;

//! Parts of a Gaussian that fall on neighbouring pixels, from pixel `first` on; they add up to 1.
struct PointSpread {
  int first = 0;
  int count = 0;
  std::array<float, 2 * widest_splat_px + 2> part;  //!< `count` of them

  //! About a place [px]; light reaches so far [px]. A spread of 0 is the pixel that holds the place.
  PointSpread(double middle_px, double sigma_px, double reach_px);
};

}  // namespace ergodome
