#include "kernels/stars/search/patch_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernels/launch/launch.h"
#include "tests/support/patch_maps.h"

namespace ergodome {
namespace {

//! A bent patch that maps the unit square one to one: a part of a ring that becomes wider along its
//! length.
struct Sliver {
  double radius, width, turn;

  [[nodiscard]] BezierPatch patch() const {
    return test::patch_of([&](double u, double v) {
      const double r = radius + width * v * (1.0 + u);
      const double angle = turn + 1.2 * u;
      return std::array<double, 2>{r * std::cos(angle), r * std::sin(angle)};
    });
  }
};

//! Pairs of a patch and a star at a known position (u, v) in the patch.
class PatchPairs : public testing::Test {
 protected:
  //! Creates pairs whose u and v are between `low` and `high`, but not within `skip` of the middle
  //! of the patch.
  void make(double low, double high, double skip) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 50; ++i) {
      slivers_.emplace_back().sky = Sliver{0.1, 0.005 + 0.05 * uniform(random), 6.0 * uniform(random)}.patch();
    }
    while (u_.size() < 1003) {
      const double u = low + (high - low) * uniform(random);
      const double v = low + (high - low) * uniform(random);
      if (std::max(std::abs(u - 0.5), std::abs(v - 0.5)) < skip) {
        continue;
      }
      const std::size_t patch = u_.size() / 21;
      const PlaneValue<double> position = seen_from(slivers_[patch].sky, 0.0, 0.0, u, v);
      pairs_.push_back(
          {static_cast<int>(patch), 0, 1.0F, static_cast<float>(position.p), static_cast<float>(position.q), false});
      u_.push_back(u);
      v_.push_back(v);
    }
  }

  [[nodiscard]] PatchPairBatch pairs() const {
    return {static_cast<int>(pairs_.size()), pairs_.data(), slivers_.data()};
  }

  [[nodiscard]] std::vector<float> sides() const {
    std::vector<float> sides(u_.size());
    run_on_this_thread(PatchSideBatch{pairs(), sides.data()});
    return sides;
  }

  std::vector<StarPatch> slivers_;
  std::vector<SearchedPair> pairs_;
  std::vector<double> u_;
  std::vector<double> v_;
};

TEST_F(PatchPairs, StarsFarFromTheBorderAreInside) {
  make(0.2, 0.8, 0.0);
  for (const float side : sides()) {
    EXPECT_EQ(side, static_cast<float>(PatchSide::inside));
  }
}

TEST_F(PatchPairs, StarsFarBeyondTheBorderAreOutside) {
  make(-0.4, 1.4, 0.6);
  for (const float side : sides()) {
    EXPECT_EQ(side, static_cast<float>(PatchSide::outside));
  }
}

TEST_F(PatchPairs, StarsOnTheBorderAreBeside) {
  make(0.0, 1.0, 0.4995);
  for (const float side : sides()) {
    EXPECT_EQ(side, static_cast<float>(PatchSide::beside));
  }
}

TEST_F(PatchPairs, NoStarIsOnTheWrongSide) {
  make(-0.2, 1.2, 0.0);
  const std::vector<float> found = sides();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool inside = std::max(std::abs(u_[i] - 0.5), std::abs(v_[i] - 0.5)) < 0.5;
    EXPECT_NE(found[i], static_cast<float>(inside ? PatchSide::outside : PatchSide::inside)) << u_[i] << ' ' << v_[i];
  }
}

TEST_F(PatchPairs, NewtonFindsThePlaceOfEachStar) {
  make(0.0, 1.0, 0.0);
  const std::size_t count = u_.size();
  std::vector<float> roots(4 * count);
  float* const to = roots.data();
  run_on_this_thread(PatchNewtonBatch{pairs(), {1e6F, 16}, to, to + count, to + 2 * count, to + 3 * count});
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(roots[i], 1.0F);
    EXPECT_NEAR(roots[count + i], u_[i], 1e-4);
    EXPECT_NEAR(roots[2 * count + i], v_[i], 1e-4);
    const double area = determinant(seen_from(slivers_[i / 21].sky, 0.0, 0.0, u_[i], v_[i]));
    EXPECT_NEAR(roots[3 * count + i], area, 2e-3 * std::abs(area));
  }
}

}  // namespace
}  // namespace ergodome
