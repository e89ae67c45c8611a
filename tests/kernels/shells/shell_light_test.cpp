#include "kernels/shells/shell_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome::test {
namespace {

constexpr float line_deg = 3.14159265F / 180.0F;

Vector3<double> position_on_sphere(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

//! Returns the footprint of a square pixel on a shell, with sides along θ and φ.
ShellFootprint footprint(double theta, double phi, float width) {
  const Vector3<double> d = position_on_sphere(theta, phi);
  const Vector3<double> south = {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)};
  const auto in_float = [](const Vector3<double>& v, float f) {
    return f * Vector3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  return {in_float(d, 1.0F), in_float(south, width),
          in_float(Vector3<double>{-std::sin(phi), std::cos(phi), 0.0}, width)};
}

//! Counts the points of a footprint that are within half a line width of a circle of latitude or a
//! meridian, by exact angles. Returns their fraction.
double counted_coverage(double theta, double phi, double size, double spacing, double width) {
  constexpr int points = 400;
  int covered = 0;
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < points; ++k) {
      const double t = theta + size * ((i + 0.5) / points - 0.5);
      const double p = phi + size / std::sin(theta) * ((k + 0.5) / points - 0.5);
      const double from_circle = std::abs(std::remainder(t, spacing));
      const double from_meridian = std::abs(std::remainder(p, spacing)) * std::sin(theta);
      covered += from_circle < 0.5 * width || from_meridian < 0.5 * width ? 1 : 0;
    }
  }
  return covered / (1.0 * points * points);
}

TEST(ShellGrid, CoversAsMuchOfAFootprintAsAreItsPoints) {
  for (const double theta : {0.2, 0.7, 1.3, 1.57, 2.6}) {
    for (const double phi : {-3.1, -1.0, 0.01, 0.3, 1.05}) {
      for (const double size : {0.003, 0.02, 0.1, 0.5}) {
        const double grid = 15.0 * static_cast<double>(line_deg);
        const double width = 2.0 * static_cast<double>(line_deg);
        const float found = grid_coverage(footprint(theta, phi, static_cast<float>(size)), static_cast<float>(grid),
                                          static_cast<float>(width));
        // The formula assumes that the width of meridians, as an angle of φ, is the same everywhere
        // in the footprint.
        const double open = 0.01 + 0.3 * size * size / (std::sin(theta) * std::sin(theta));
        EXPECT_NEAR(static_cast<double>(found), counted_coverage(theta, phi, size, grid, width), open)
            << theta << " " << phi << " " << size;
      }
    }
  }
}

TEST(ShellGrid, HasLinesOfOneWidthAtAllLatitudes) {
  // A point at a quarter of the line width from a meridian's center is inside the line; one at
  // three quarters is outside. This must hold at every latitude.
  for (const double theta : {0.12, 0.5, 1.45, 3.0}) {
    const double inside = 0.25 * static_cast<double>(line_deg) / std::sin(theta);
    const float spacing = 15.0F * line_deg;
    EXPECT_NEAR(grid_coverage(footprint(theta, inside, 1e-5F), spacing, line_deg), 1.0F, 1e-3F) << theta;
    EXPECT_NEAR(grid_coverage(footprint(theta, 3.0 * inside, 1e-5F), spacing, line_deg), 0.0F, 1e-3F) << theta;
  }
}

TEST(ShellGrid, IsEvenAndFiniteAtThePoles) {
  const float spacing = 15.0F * line_deg;
  for (const double theta : {0.0, 1e-9, 1e-4, 3.14159265358979}) {
    for (const float width : {1e-6F, 1e-2F, 0.3F}) {
      const float found = grid_coverage(footprint(theta, 1.0, width), spacing, line_deg);
      EXPECT_GE(found, 0.0F) << theta << " " << width;
      EXPECT_LE(found, 1.0F) << theta << " " << width;
    }
    // At the poles, the lines of meridians touch and cover everything.
    EXPECT_EQ(grid_coverage(footprint(theta, 1.0, 1e-6F), spacing, line_deg), 1.0F) << theta;
  }
  // In pixels that are as wide as the distance between meridians, the coverage is the same at any
  // azimuth.
  const float here = grid_coverage(footprint(0.02, 0.0, 0.05F), spacing, line_deg);
  EXPECT_NEAR(grid_coverage(footprint(0.02, 0.13, 0.05F), spacing, line_deg), here, 0.02F);
}

TEST(ShellGrid, FadesIntoItsMeanWhereLinesAreFinerThanPixels) {
  const float spacing = line_deg;
  const float width = 0.1F * line_deg;
  const float mean = 1.0F - 0.9F * 0.9F;
  for (const double theta : {0.9, 1.2, 1.5707963}) {
    EXPECT_NEAR(grid_coverage(footprint(theta, 0.4, 60.0F * line_deg), spacing, width),
                1.0F - 0.9F * (1.0F - 0.1F / static_cast<float>(std::sin(theta))), 1e-3F)
        << theta;
  }
  EXPECT_NEAR(grid_coverage(footprint(1.5707963, 0.4, 60.0F * line_deg), spacing, width), mean, 1e-3F);
  // Next to the critical curve, the footprint of a pixel may even be NaN.
  ShellFootprint lost = footprint(1.5707963, 0.4, 1.0F);
  lost.along_x.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(grid_coverage(lost, spacing, width), mean, 0.3F);
}

}  // namespace
}  // namespace ergodome::test
