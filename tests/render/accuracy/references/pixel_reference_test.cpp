#include "render/accuracy/references/pixel_reference.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/render/accuracy/accuracy_scene.h"
#include "tests/render/accuracy/cash_karp_ray.h"

namespace ergodome {
namespace {

//! Returns the sky direction at a position in the picture of a moment, by traced rays.
Vector3<double> traced(const AccuracyMoment& moment, double x_px, double y_px) {
  const Vector3<double> view = direction_from_pixel(moment.projection, x_px, y_px);
  const auto part = [&](int i) {
    const double(&m)[3] = moment.eye.frame_from_view[i];
    return m[0] * view.x + m[1] * view.y + m[2] * view.z;
  };
  return test::cash_karp_sky(moment.eye, {part(0), part(1), part(2)});
}

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

class PixelReferenceOfADome : public testing::Test {
 protected:
  PixelReferenceOfADome()
      : moment_(accuracy_moments(test::small_dome(), test::few()).front()),
        lattice_(pixel_lattice(moment_.projection, 16, 1)),
        reference_(moment_.eye, moment_.projection, lattice_.pixels, moment_.pixel) {}

  //! Returns the sky direction at the given distances to the right of and below the center of a
  //! pixel.
  [[nodiscard]] Vector3<double> beside(std::size_t i, double right_px, double down_px) const {
    const auto [x, y] = pixel_middle(lattice_.pixels[i], moment_.projection.width_px);
    return traced(moment_, x + right_px, y + down_px);
  }

  AccuracyMoment moment_;
  PixelLattice lattice_;
  PixelReference reference_;
};

TEST_F(PixelReferenceOfADome, FindsNothingWrongWithExactRays) {
  int compared = 0;
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    if (reference_.counts(i) && reference_.is_lit(i)) {
      EXPECT_LT(length(reference_.miss(i, beside(i, 0.0, 0.0))), 1e-6);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST_F(PixelReferenceOfADome, CallsAHundredthOfAPixelAHundredthOfAPixel) {
  // The pixels of a dome have the same angular size along the radius everywhere; across the radius,
  // they are slightly smaller towards the rim.
  int compared = 0;
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    if (reference_.counts(i) && reference_.is_lit(i)) {
      for (const double side : {-0.01, 0.01}) {
        const double miss = length(reference_.miss(i, beside(i, side, 0.0)));
        EXPECT_LT(miss, 0.011);
        EXPECT_GT(miss, 0.01 * 2.0 / 3.14159 * 0.95);
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST_F(PixelReferenceOfADome, CallsALostPixelAsWrongAsTheEdgeIsFar) {
  int dark = 0;
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    if (!reference_.counts(i)) {
      continue;
    }
    if (reference_.is_lit(i)) {
      EXPECT_GT(length(reference_.miss(i, std::nullopt)), 1.0);
    } else {
      ++dark;
      EXPECT_EQ(length(reference_.miss(i, std::nullopt)), 0.0);
      EXPECT_GT(length(reference_.miss(i, Vector3<double>{0.0, 0.0, 1.0})), 1.0);
    }
  }
  EXPECT_GT(dark, 3);
}

TEST(PixelLattice, TakesOnePixelOfEachCellAndTheSameForASeed) {
  const Projection projection = accuracy_moments(test::small_dome(), test::few()).front().projection;
  const PixelLattice lattice = pixel_lattice(projection, 12, 7);
  EXPECT_EQ(lattice.columns, 12);
  EXPECT_EQ(lattice.rows, 12);
  EXPECT_EQ(lattice.pixels, pixel_lattice(projection, 12, 7).pixels);
  EXPECT_NE(lattice.pixels, pixel_lattice(projection, 12, 8).pixels);
  for (std::size_t i = 0; i < lattice.pixels.size(); ++i) {
    const auto cell = static_cast<std::int64_t>(i);
    EXPECT_EQ(lattice.pixels[i] % 48 / 4, cell % 12);
    EXPECT_EQ(lattice.pixels[i] / 48 / 4, cell / 12);
  }
}

TEST(PixelLattice, HasNoMoreCellsThanPixels) {
  Projection projection = accuracy_moments(test::small_dome(), test::few()).front().projection;
  projection.width_px = 3;
  projection.height_px = 1;
  const PixelLattice lattice = pixel_lattice(projection, 200, 1);
  EXPECT_THAT(lattice.pixels, testing::ElementsAre(0, 1, 2));
}

TEST(AccuracyMoments, OfAStillCameraAreOneAndItsNextFrameIsTurnedByHalfAPixel) {
  AccuracySettings settings = test::few();
  settings.moments = 5;
  const std::vector<AccuracyMoment> moments = accuracy_moments(test::small_dome(), settings);
  ASSERT_EQ(moments.size(), 1U);
  const glm::dquat turn = glm::inverse(moments[0].pose.orientation) * moments[0].next_pose.orientation;
  EXPECT_NEAR(2.0 * std::acos(std::min(std::abs(turn.w), 1.0)), 0.5 * moments[0].pixel, 1e-6);
}

TEST(AccuracyMoments, OfAShowLieEvenlyWithinIt) {
  Show show = test::small_dome();
  show.duration_s = 30.0;
  show.camera.keys.push_back(show.camera.keys.front());
  show.camera.keys.back().time_s = 30.0;
  show.camera.keys.back().r = 12.0;
  AccuracySettings settings = test::few();
  settings.moments = 3;
  std::vector<double> times_s;
  for (const AccuracyMoment& moment : accuracy_moments(show, settings)) {
    times_s.push_back(moment.time_s);
    EXPECT_GT(moment.next.r, moment.eye.r);
  }
  EXPECT_THAT(times_s, testing::ElementsAre(5.0, 15.0, 25.0));
}

}  // namespace
}  // namespace ergodome
