#include "render/eyes/disk_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

double value_of(const std::vector<double>& coefficients, const DiskPoint& point, int degree) {
  const std::vector<double> terms = disk_terms(point, degree);
  double sum = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    sum += coefficients[i] * terms[i];
  }
  return sum;
}

std::vector<double> fitted(int degree, double (*function)(double p, double q)) {
  const std::vector<DiskPoint> points = disk_points(degree + 1, 2 * degree + 3, 0.0);
  std::vector<double> values;
  values.reserve(points.size());
  for (const DiskPoint& point : points) {
    values.push_back(function(point.p, point.q));
  }
  return DiskFit(points, degree).fit(values);
}

TEST(DiskFit, FindsAPolynomialItself) {
  const auto cubic = [](double p, double q) { return 3.0 - p + 2.0 * p * q + q * q - 0.5 * p * p * q; };
  const std::vector<double> coefficients = fitted(3, cubic);
  const double expected[] = {3.0, -1.0, 0.0, 0.0, 2.0, 1.0, 0.0, -0.5, 0.0, 0.0};
  ASSERT_EQ(coefficients.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(coefficients[i], expected[i], 1e-13) << i;
  }
}

TEST(DiskFit, HigherDegreesComeNearerToASmoothFunction) {
  const auto bump = [](double p, double q) { return std::exp(p) / (3.0 + q); };
  double before = 1.0;
  for (const int degree : {2, 4, 6, 8, 10}) {
    const std::vector<double> coefficients = fitted(degree, bump);
    double worst = 0.0;
    for (const DiskPoint& point : disk_points(5, 23, 0.3)) {
      worst = std::max(worst, std::abs(value_of(coefficients, point, degree) - bump(point.p, point.q)));
    }
    EXPECT_LT(worst, 0.2 * before) << degree;
    before = worst;
  }
  EXPECT_LT(before, 1e-7);
}

TEST(DiskFit, PlacesLieOnTheDiskAndReachItsRim) {
  double farthest = 0.0;
  for (const DiskPoint& point : disk_points(4, 9, 0.25)) {
    farthest = std::max(farthest, std::hypot(point.p, point.q));
  }
  EXPECT_NEAR(farthest, 1.0, 1e-15);
}

}  // namespace
}  // namespace ergodome
