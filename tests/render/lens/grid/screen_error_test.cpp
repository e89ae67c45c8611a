#include "render/lens/grid/screen_error.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

//! Returns the quantiles of a lens whose error is 0.5, 1.5, ... 999.5 px in a thousand equal parts
//! of the sky; `share` is the share of the sky that the screen shows.
ScreenError error_of_parts(double share) {
  std::vector<double> error_px;
  error_px.reserve(1000);
  for (int i = 0; i < 1000; ++i) {
    error_px.push_back(i + 0.5);
  }
  return bounds_of(error_px, std::vector<double>(error_px.size(), 2.0), share);
}

TEST(ScreenError, LeavesAHundredthOfWhatAScreenShowsOut) {
  EXPECT_NEAR(error_of_parts(1.0).p99_px, 990.0, 1.0);
  EXPECT_NEAR(error_of_parts(0.5).p99_px, 995.0, 1.0);
  EXPECT_NEAR(error_of_parts(0.2).p99_px, 998.0, 1.0);
}

TEST(ScreenError, OfANarrowScreenIsThatOfATenthOfTheSky) {
  EXPECT_EQ(error_of_parts(0.001).p99_px, error_of_parts(0.1).p99_px);
  EXPECT_EQ(error_of_parts(0.001).p999_px, error_of_parts(1.0).p999_px);
}

}  // namespace
}  // namespace ergodome
