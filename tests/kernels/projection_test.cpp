#include "kernels/projection/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/core/dual.h"

namespace ergodome {
namespace {

constexpr double pi = 3.14159265358979323846;

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

class EveryProjection : public testing::TestWithParam<int> {
 protected:
  static Projection projection() {
    switch (GetParam()) {
      case 0:
        return make_dome_projection(800, 1.2 * pi, 0.3);
      case 1:
        return make_equirectangular_projection(800, 400);
      default:
        return make_pinhole_projection(800, 600, 1.3);
    }
  }

  static void inverse(const Projection& p, const Vector3<double>& v, double& x, double& y) {
    switch (p.kind) {
      case ProjectionKind::dome_fisheye:
        fisheye_from_direction(p.dome, v, x, y);
        break;
      case ProjectionKind::equirectangular:
        equirectangular_from_direction(v, x, y);
        break;
      case ProjectionKind::pinhole:
        pinhole_from_direction(p.pinhole, v, x, y);
        break;
    }
  }
};

TEST_P(EveryProjection, GivesUnitVectorsThatItsInverseTakesBack) {
  const Projection p = projection();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.69, 0.69);
  for (int i = 0; i < 200; ++i) {
    const double x = place(random);
    const double y = place(random);
    const Vector3<double> v = direction_from_pixel(p, (x + 1.0) * 0.5 * p.width_px, (1.0 - y) * 0.5 * p.height_px);
    EXPECT_NEAR(dot(v, v), 1.0, 1e-14);
    double back_x = 0.0;
    double back_y = 0.0;
    inverse(p, v, back_x, back_y);
    EXPECT_NEAR(back_x, x, 1e-13);
    EXPECT_NEAR(back_y, y, 1e-13);
  }
}

TEST_P(EveryProjection, DerivativesAreThoseOfDifferenceQuotients) {
  const Projection p = projection();
  const double x = 0.61 * p.width_px;
  const double y = 0.37 * p.height_px;
  const auto v = direction_from_pixel(p, Dual<double>(x, 1.0, 0.0), Dual<double>(y, 0.0, 1.0));
  const double h = 1e-3;
  const Vector3<double> dx = (0.5 / h) * (direction_from_pixel(p, x + h, y) - direction_from_pixel(p, x - h, y));
  const Vector3<double> dy = (0.5 / h) * (direction_from_pixel(p, x, y + h) - direction_from_pixel(p, x, y - h));
  EXPECT_NEAR(v.x.along_x, dx.x, 1e-10);
  EXPECT_NEAR(v.y.along_x, dx.y, 1e-10);
  EXPECT_NEAR(v.z.along_x, dx.z, 1e-10);
  EXPECT_NEAR(v.x.along_y, dy.x, 1e-10);
  EXPECT_NEAR(v.y.along_y, dy.y, 1e-10);
  EXPECT_NEAR(v.z.along_y, dy.z, 1e-10);
}

TEST_P(EveryProjection, IsFiniteEverywhereInFloatWithItsDerivatives) {
  const auto p = converted_projection<float>(projection());
  for (int y = 0; y <= p.height_px; y += 8) {
    for (int x = 0; x <= p.width_px; x += 8) {
      const auto v = direction_from_pixel(p, Dual<float>(static_cast<float>(x), 1.0F, 0.0F),
                                          Dual<float>(static_cast<float>(y), 0.0F, 1.0F));
      ASSERT_TRUE(std::isfinite(v.x.value + v.x.along_x + v.x.along_y));
      ASSERT_TRUE(std::isfinite(v.y.value + v.y.along_x + v.y.along_y));
      ASSERT_TRUE(std::isfinite(v.z.value + v.z.along_x + v.z.along_y));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, EveryProjection, testing::Values(0, 1, 2), [](const auto& each) {
  return std::string(each.param == 0 ? "Dome" : each.param == 1 ? "Equirectangular" : "Pinhole");
});

}  // namespace
}  // namespace ergodome
