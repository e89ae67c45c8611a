#pragma once

#include <array>
#include <cstddef>
#include <vector>

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

  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): most of the parts are never read
  PointSpread() {}
};

//! A Gaussian with a given sigma [px], truncated at `reach_px` to both sides. Tabulates its integral, because a picture
//! has thousands of points with the same Gaussian; fractions are accurate to 2e-6.
class PointSpreads {
 public:
  //! With a sigma of 0, all light falls on the pixel that contains the center. Other sigmas are at least 0.01 px.
  PointSpreads(double sigma_px, double reach_px);

  //! Computes the fractions of the Gaussian with its center at `middle_px`.
  void spread(double middle_px, PointSpread& spread) const;

 private:
  double reach_px_;
  int steps_a_px_ = 0;       //!< number of steps per pixel; 0 for a sigma of 0
  std::size_t columns_ = 0;  //!< maximum number of pixel edges inside the Gaussian
  //! One row per step of the distance of the first pixel edge from the start of the Gaussian. A row has, for each edge, the
  //! fraction of the light before it, and then, for each edge, the change of that per step.
  std::vector<float> table_;
};

}  // namespace ergodome
