#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/projection/pixel_measure.h"
#include "tests/support/projections.h"

namespace ergodome {
namespace {

void expect_direction(const Vector3<double>& v, double x, double y, double z) {
  EXPECT_NEAR(v.x, x, 1e-12);
  EXPECT_NEAR(v.y, y, 1e-12);
  EXPECT_NEAR(v.z, z, 1e-12);
}

Projection dome(double tilt_deg = 0.0) { return make_dome_projection(1000, pi, tilt_deg * pi / 180.0); }

TEST(DomeFisheye, CentreIsTheZenith) { expect_direction(direction_from_pixel(dome(), 500.0, 500.0), 0.0, 1.0, 0.0); }

TEST(DomeFisheye, BottomOfTheImageIsTheFrontAndRightIsRight) {
  expect_direction(direction_from_pixel(dome(), 500.0, 1000.0), 0.0, 0.0, -1.0);
  expect_direction(direction_from_pixel(dome(), 1000.0, 500.0), 1.0, 0.0, 0.0);
}

TEST(DomeFisheye, ZenithAngleGrowsEvenlyWithTheRadius) {
  const Vector3<double> v = direction_from_pixel(dome(), 500.0, 500.0 - 250.0);
  expect_direction(v, 0.0, std::cos(pi / 4), std::sin(pi / 4));
}

TEST(DomeFisheye, TiltLowersTheFrontRim) {
  const Vector3<double> front = direction_from_pixel(dome(20.0), 500.0, 1000.0);
  EXPECT_NEAR(std::asin(front.y) * 180.0 / pi, -20.0, 1e-10);
}

TEST(DomeFisheye, RimOfTheImageFadesOverOnePixelAndOutsideIsDark) {
  EXPECT_EQ(image_coverage(dome(), 500.0, 998.0), 1.0);
  EXPECT_NEAR(image_coverage(dome(), 500.0, 1000.0), 0.5, 1e-12);
  EXPECT_EQ(image_coverage(dome(), 10.0, 10.0), 0.0);
}

TEST(DomeFisheye, FullSphereFieldOfViewShowsTheNadirAtTheRim) {
  const Projection sphere = make_dome_projection(100, 2.0 * pi, 0.0);
  expect_direction(direction_from_pixel(sphere, 100.0, 50.0), 0.0, -1.0, 0.0);
}

TEST(Equirectangular, MiddleIsForwardAndTheEdgesAreBehind) {
  const Projection p = make_equirectangular_projection(2000, 1000);
  expect_direction(direction_from_pixel(p, 1000.0, 500.0), 0.0, 0.0, -1.0);
  expect_direction(direction_from_pixel(p, 1500.0, 500.0), 1.0, 0.0, 0.0);
  expect_direction(direction_from_pixel(p, 1000.0, 0.0), 0.0, 1.0, 0.0);
  const Vector3<double> left = direction_from_pixel(p, 0.0, 300.0);
  const Vector3<double> right = direction_from_pixel(p, 2000.0, 300.0);
  expect_direction(left, right.x, right.y, right.z);
}

TEST(Equirectangular, HalfASkyEndsAtTheViewersSides) {
  const Projection p = make_equirectangular_projection(1000, 1000, pi);
  expect_direction(direction_from_pixel(p, 500.0, 500.0), 0.0, 0.0, -1.0);
  expect_direction(direction_from_pixel(p, 1000.0, 500.0), 1.0, 0.0, 0.0);
  expect_direction(direction_from_pixel(p, 0.0, 500.0), -1.0, 0.0, 0.0);
  expect_direction(direction_from_pixel(p, 250.0, 0.0), 0.0, 1.0, 0.0);
  double x = 0.0;
  double y = 0.0;
  EXPECT_TRUE(pixel_from_direction(p, {0.1, 0.0, 1.0}, x, y));
  EXPECT_GT(x, 1000.0) << "behind the viewer, to the right";
}

TEST(Pinhole, EdgeOfTheImageIsAtHalfTheFieldOfView) {
  const Projection p = make_pinhole_projection(200, 100, pi / 2);
  expect_direction(direction_from_pixel(p, 200.0, 50.0), std::sqrt(0.5), 0.0, -std::sqrt(0.5));
  const Vector3<double> top = direction_from_pixel(p, 100.0, 0.0);
  EXPECT_NEAR(top.y / -top.z, 0.5, 1e-12);
}

TEST(Pinhole, HasNoPlaceForWhatIsBehindTheCamera) {
  const Projection p = make_pinhole_projection(200, 100, pi / 2);
  double x = 0.0;
  double y = 0.0;
  EXPECT_FALSE(pinhole_from_direction(p.pinhole, {0.0, 0.0, 1.0}, x, y));
  EXPECT_FALSE(pinhole_from_direction(p.pinhole, {1.0, 0.0, 0.0}, x, y));
}

TEST(Pinhole, SidesOfAFrustumLieWhereItsTangentsSay) {
  const Projection p = make_frustum_projection(300, 200, {-0.5, 1.0, 0.75, -0.25});
  const auto expect_tangents = [&](double x_px, double y_px, double right, double up) {
    const Vector3<double> v = direction_from_pixel(p, x_px, y_px);
    EXPECT_NEAR(v.x / -v.z, right, 1e-12);
    EXPECT_NEAR(v.y / -v.z, up, 1e-12);
  };
  expect_tangents(0.0, 0.0, -0.5, 0.75);
  expect_tangents(300.0, 200.0, 1.0, -0.25);
  expect_tangents(100.0, 150.0, 0.0, 0.0);
}

TEST(Cylinder, HeightIsTheTangentOfTheElevation) {
  const Projection p = make_cylinder_projection(400, 300, 2.0 * pi, -1.0, 2.0);
  expect_direction(direction_from_pixel(p, 200.0, 200.0), 0.0, 0.0, -1.0);
  expect_direction(direction_from_pixel(p, 300.0, 200.0), 1.0, 0.0, 0.0);
  const Vector3<double> above = direction_from_pixel(p, 100.0, 0.0);
  EXPECT_NEAR(above.y / -above.x, 2.0, 1e-12);
  const Vector3<double> below = direction_from_pixel(p, 200.0, 300.0);
  EXPECT_NEAR(std::atan2(below.y, -below.z), -pi / 4, 1e-12);
}

TEST(Cylinder, HasNoPlaceForTheZenith) {
  double x = 0.0;
  double y = 0.0;
  EXPECT_FALSE(pixel_from_direction(make_cylinder_projection(400, 300, 2.0 * pi, -1.0, 1.0), {0.0, 1.0, 0.0}, x, y));
}

TEST(Cylinder, WrapsAroundWhenItIsWhole) {
  EXPECT_TRUE(wraps_around(make_cylinder_projection(400, 300, 2.0 * pi, -1.0, 1.0)));
  EXPECT_FALSE(wraps_around(make_cylinder_projection(400, 300, 1.9 * pi, -1.0, 1.0)));
  EXPECT_TRUE(wraps_around(make_equirectangular_projection(400, 200)));
  EXPECT_FALSE(wraps_around(make_equirectangular_projection(400, 210, 1.9 * pi)));
  EXPECT_FALSE(wraps_around(dome()));
}

TEST(Projection, SeenFromOutsideIsTheMirrorImage) {
  const Projection inside = dome(20.0);
  const Projection outside = seen_from_outside(inside);
  const Vector3<double> v = direction_from_pixel(inside, 700.0, 400.0);
  expect_direction(direction_from_pixel(outside, 300.0, 400.0), v.x, v.y, v.z);
  EXPECT_EQ(image_coverage(outside, 980.0, 560.0), image_coverage(inside, 20.0, 560.0));
}

using test::every_projection;
using test::image_positions;
using test::ImagePosition;
using test::NamedProjection;

class EveryProjection : public testing::TestWithParam<NamedProjection> {
 protected:
  const Projection& projection() const { return GetParam().projection; }
};

TEST_P(EveryProjection, TakesPixelsToUnitVectorsAndBack) {
  const Projection& p = projection();
  for (const ImagePosition& position : image_positions(p, 1e-3)) {
    const Vector3<double> v = direction_from_pixel(p, position.x_px, position.y_px);
    EXPECT_NEAR(dot(v, v), 1.0, 1e-14);
    ImagePosition back{};
    ASSERT_TRUE(pixel_from_direction(p, v, back.x_px, back.y_px)) << position.x_px << " " << position.y_px;
    EXPECT_NEAR(back.x_px, position.x_px, 1e-4) << position.y_px;
    EXPECT_NEAR(back.y_px, position.y_px, 1e-4) << position.x_px;
  }
}

TEST_P(EveryProjection, InFloatMissesAPixelByLittle) {
  const Projection& p = projection();
  const auto narrow = converted_projection<float>(p);
  for (const ImagePosition& position : image_positions(p, 0.5)) {
    const auto v = direction_from_pixel(narrow, static_cast<float>(position.x_px), static_cast<float>(position.y_px));
    const Vector3<double> wide = {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    ImagePosition back{};
    ASSERT_TRUE(pixel_from_direction(p, wide, back.x_px, back.y_px)) << position.x_px << " " << position.y_px;
    EXPECT_NEAR(back.x_px, position.x_px, 5e-3) << position.y_px;
    EXPECT_NEAR(back.y_px, position.y_px, 5e-3) << position.x_px;
  }
}

TEST_P(EveryProjection, DerivativesAreThoseOfDifferenceQuotients) {
  const Projection& p = projection();
  for (const ImagePosition& position : image_positions(p, 0.5)) {
    const double x = position.x_px;
    const double y = position.y_px;
    const PixelSteps<double> steps = pixel_steps(p, x, y);
    const double h = 1e-3;
    const auto expect_alike = [&](const Vector3<double>& step, const Vector3<double>& change) {
      const Vector3<double> apart = step - (0.5 / h) * change;
      EXPECT_LT(dot(apart, apart), 1e-20 + 1e-9 * dot(step, step)) << x << " " << y;
    };
    expect_alike(steps.across, direction_from_pixel(p, x + h, y) - direction_from_pixel(p, x - h, y));
    expect_alike(steps.down, direction_from_pixel(p, x, y + h) - direction_from_pixel(p, x, y - h));
  }
}

TEST_P(EveryProjection, IsFiniteEverywhereInFloatWithItsDerivatives) {
  const auto p = converted_projection<float>(projection());
  for (int y = -2; y <= p.height_px + 2; y += 2) {
    for (int x = -2; x <= p.width_px + 2; x += 2) {
      const auto v = direction_from_pixel(p, Dual<float>(static_cast<float>(x), 1.0F, 0.0F),
                                          Dual<float>(static_cast<float>(y), 0.0F, 1.0F));
      ASSERT_TRUE(std::isfinite(v.x.value + v.x.along_x + v.x.along_y)) << x << " " << y;
      ASSERT_TRUE(std::isfinite(v.y.value + v.y.along_x + v.y.along_y)) << x << " " << y;
      ASSERT_TRUE(std::isfinite(v.z.value + v.z.along_x + v.z.along_y)) << x << " " << y;
    }
  }
}

TEST_P(EveryProjection, ShowsSimdLanesWhatItShowsSinglePixels) {
  using Lanes = WidePack<float>;
  const auto p = converted_projection<float>(projection());
  const int count = p.width_px * p.height_px;
  // Tests SIMD packs that extend over the ends of rows and of cube faces, too.
  for (int first = 0; first < count; first += 997) {
    Lanes x_px;
    Lanes y_px;
    pixel_middles(p.width_px, 0, count, first, x_px, y_px);
    const Vector3<Lanes> many = direction_from_pixel(p, x_px, y_px);
    const Lanes coverage = image_coverage(p, x_px, y_px);
    for (int i = 0; i < RealTraits<Lanes>::lane_count; ++i) {
      const Vector3<float> one = direction_from_pixel(p, lane(x_px, i), lane(y_px, i));
      ASSERT_NEAR(lane(many.x, i), one.x, 1e-6F) << first + i;
      ASSERT_NEAR(lane(many.y, i), one.y, 1e-6F) << first + i;
      ASSERT_NEAR(lane(many.z, i), one.z, 1e-6F) << first + i;
      ASSERT_NEAR(lane(coverage, i), image_coverage(p, lane(x_px, i), lane(y_px, i)), 1e-4F) << first + i;
    }
  }
}

//! At the rim of a sphere or hemisphere, pixel angles would grow without bound. They are limited to
//! those half a pixel inside the rim, so pixels are checked only up to there.
TEST_P(EveryProjection, HasNoPixelLargerThanItsLargest) {
  const Projection& p = projection();
  const double largest = largest_pixel_angle(p);
  for (int y = 0; y < p.height_px; y += 3) {
    for (int x = 0; x < p.width_px; x += 3) {
      if (image_coverage(p, x + 0.5, y + 0.5) >= 1.0) {
        ASSERT_LT(pixel_side(p, x + 0.5, y + 0.5), 1.02 * largest) << x << " " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, EveryProjection, testing::ValuesIn(every_projection()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace ergodome
