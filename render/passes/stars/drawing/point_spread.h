#pragma once

#include <array>

namespace ergodome {

//! Maximum distance of pixels, to each side of its center, that a point's light reaches: three
//! times the largest sigma_px (100) in a dome four times finer than the one for which it was
//! configured.
inline constexpr int widest_splat_px = 1201;

//! Fractions of a Gaussian that fall on adjacent pixels, starting at pixel `first`; they add up to
//! 1.
struct PointSpread {
  int first = 0;
  int count = 0;
  //! Fraction for each pixel from `first` on; only `count` entries are set.
  std::array<float, 2 * widest_splat_px + 2> part;

  //! Centers the Gaussian at `middle_px` and truncates it at `reach_px` to both sides [px]. With a
  //! sigma of 0, all light falls on the pixel that contains the center.
  PointSpread(double middle_px, double sigma_px, double reach_px);
};

}  // namespace ergodome
