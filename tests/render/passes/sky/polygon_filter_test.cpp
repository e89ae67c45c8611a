#include "render/passes/sky/polygon_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "content/sky/sky_map.h"
#include "kernels/core/angles.h"
#include "kernels/sky/elliptic_filter.h"
#include "render/passes/sky/sky_cube.h"

namespace ergodome {
namespace {

EnvironmentImage image_of(int width, const std::function<glm::dvec3(const glm::dvec3&)>& light) {
  EnvironmentImage image;
  image.width = width;
  image.height = width / 2;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 rgb = light(direction_from_map((x + 0.5) / image.width, (y + 0.5) / image.height));
      for (int part = 0; part < 3; ++part) {
        image.rgb.push_back(static_cast<float>(rgb[part]));
      }
    }
  }
  return image;
}

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

//! The footprint of a pixel on the sky: its direction, and the changes of the direction across the
//! pixel.
struct Footprint {
  glm::dvec3 direction;
  glm::dvec3 along_x;
  glm::dvec3 along_y;
};

//! Returns the footprint of a pixel with angular sizes a and b, rotated and skewed at random.
Footprint random_footprint(const glm::dvec3& direction, double a, double b, std::mt19937& random) {
  const glm::dvec3 first = glm::normalize(glm::cross(direction, random_direction(random)));
  const glm::dvec3 second = glm::cross(direction, first);
  std::uniform_real_distribution<double> skew(-0.5, 0.5);
  return {direction, a * first, b * second + skew(random) * a * first};
}

glm::dvec3 moved(const glm::dvec3& direction, const glm::dvec3& tangent) {
  const double angle = glm::length(tangent);
  return std::cos(angle) * direction + (std::sin(angle) / angle) * tangent;
}

//! Returns the mean direction over a pixel whose sides are great circles. By Lambert's formula for
//! the irradiance vector, half of the sum over the sides of length times unit normal is the
//! integral of the direction; the solid angle is the spherical excess.
glm::dvec3 mean_direction(const Footprint& footprint) {
  const glm::dvec3 corners[] = {moved(footprint.direction, -0.5 * (footprint.along_x + footprint.along_y)),
                                moved(footprint.direction, 0.5 * (footprint.along_x - footprint.along_y)),
                                moved(footprint.direction, 0.5 * (footprint.along_x + footprint.along_y)),
                                moved(footprint.direction, 0.5 * (footprint.along_y - footprint.along_x))};
  glm::dvec3 integral(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 normal = glm::cross(corners[i], corners[(i + 1) % 4]);
    const double sine = glm::length(normal);
    integral += 0.5 * std::atan2(sine, glm::dot(corners[i], corners[(i + 1) % 4])) * normal / sine;
  }
  const auto triangle = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 2.0 *
           std::atan2(glm::dot(a, glm::cross(b - a, c - a)), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  };
  return integral / (triangle(corners[0], corners[1], corners[2]) + triangle(corners[0], corners[2], corners[3]));
}

glm::dvec4 seen(const PolygonFilter& filter, const Footprint& footprint) {
  return filter.light(footprint.direction, footprint.along_x, footprint.along_y);
}

TEST(ColumnSums, InFloatTheLowerPoleWouldBeLost) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.5F, 1.0F);
  EnvironmentImage image;
  image.width = 1;
  image.height = 2048;
  for (int i = 0; i < 3 * 2048; ++i) {
    image.rgb.push_back(uniform(random));
  }
  const ColumnSums sums(image, nullptr);
  double worst = 0.0;
  double worst_in_float = 0.0;
  float in_float = 0.0F;
  for (int row = 0; row < 2048; ++row) {
    const double top = std::cos(pi * row / 2048);
    const double bottom = std::cos(pi * (row + 1) / 2048);
    const auto exact = static_cast<double>(image.rgb[3 * static_cast<std::size_t>(row)]);
    glm::dvec4 light(0.0);
    sums.add_above(0, {bottom, row}, {bottom, row}, 1.0, light);
    sums.add_above(0, {top, row}, {top, row}, -1.0, light);
    worst = std::max(worst, std::abs(light.x / (top - bottom) / exact - 1.0));
    const float before = in_float;
    in_float += static_cast<float>(exact * (top - bottom));
    worst_in_float =
        std::max(worst_in_float, std::abs(static_cast<double>(in_float - before) / (top - bottom) / exact - 1.0));
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_GT(worst_in_float, 0.01);
}

TEST(PolygonFilter, ConstantMapIsConstantWithPolesAndSeam) {
  const PolygonFilter filter(image_of(64, [](const glm::dvec3&) { return glm::dvec3(0.25, 0.5, 2.0); }),
                             glm::dmat3(1.0), nullptr);
  std::mt19937 random(2);
  const double parts[] = {0.0, 1e-12, 1e-6, 1e-3, 0.03, 0.4, 1.5};
  for (const double a : parts) {
    for (const double b : parts) {
      for (int i = 0; i < 60; ++i) {
        // Directions all over the sky, at and near the poles, and at the seam of the map (right
        // ascension 90°).
        glm::dvec3 direction = random_direction(random);
        if (i % 3 == 1) {
          direction =
              glm::normalize(glm::dvec3(0.0, 0.0, i % 2 == 0 ? 1.0 : -1.0) + (i < 9 ? 0.0 : 0.5 * a) * direction);
        } else if (i % 3 == 2) {
          direction = glm::normalize(glm::dvec3(0.0, 1.0, direction.z));
        }
        const glm::dvec4 light = seen(filter, random_footprint(direction, a, b, random));
        ASSERT_NEAR(light.x, 0.25, 1e-6) << a << " " << b;
        ASSERT_NEAR(light.z, 2.0, 1e-5) << a << " " << b;
      }
    }
  }
}

TEST(PolygonFilter, LinearMapHasItsMeanOverSmallAndHugePixels) {
  const PolygonFilter filter(image_of(1024, [](const glm::dvec3& d) { return 1.0 + d; }), glm::dmat3(1.0), nullptr);
  std::mt19937 random(3);
  for (const double a : {1e-4, 0.02, 0.2, 0.7, 1.4}) {
    for (const double b : {1e-4, 0.02, 0.2, 0.7, 1.4}) {
      // The map is constant within a texel, which causes a larger error in pixels narrower than a
      // texel.
      const double limit = std::min(a, b) < 0.1 ? 4e-3 : 1.5e-3;
      for (int i = 0; i < 200; ++i) {
        glm::dvec3 direction = random_direction(random);
        direction = i % 4 == 0 ? glm::normalize(glm::dvec3(0.0, 0.0, i % 8 == 0 ? 1.0 : -1.0) + 0.7 * a * direction)
                               : direction;
        const Footprint footprint = random_footprint(direction, a, b, random);
        if (0.5 * std::max(glm::length(footprint.along_x + footprint.along_y),
                           glm::length(footprint.along_x - footprint.along_y)) >=
            1.25) {
          continue;
        }
        const glm::dvec3 exact = 1.0 + mean_direction(footprint);
        const glm::dvec4 light = seen(filter, footprint);
        for (int part = 0; part < 3; ++part) {
          ASSERT_NEAR(light[part], exact[part], limit) << a << " " << b << " " << direction.z;
        }
      }
    }
  }
}

TEST(PolygonFilter, PixelInsideATexelHasItsLight) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform;
  const EnvironmentImage image = image_of(64, [&](const glm::dvec3&) { return glm::dvec3(uniform(random), 1.0, 0.0); });
  // The axes of the map are rotated relative to the sky, as for the built-in map.
  const glm::dmat3 turn = sky_from_map(SkySettings{});
  const PolygonFilter filter(image, turn, nullptr);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const glm::dvec3 d = turn * direction_from_map((x + 0.5) / 64, (y + 0.5) / 32);
      const glm::dvec4 light = seen(filter, random_footprint(d, 1e-3, 1e-4, random));
      EXPECT_NEAR(light.x, image.rgb[static_cast<std::size_t>(3 * (64 * y + x))], 1e-7);
    }
  }
}

TEST(PolygonFilter, PixelThatMeetsWholeTexelsHasTheirMean) {
  // At the equator, rows of the map are nearly great circles. The pixel covers two columns and half
  // of a third one.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  const EnvironmentImage image = image_of(2048, [&](const glm::dvec3&) { return glm::dvec3(uniform(random)); });
  const PolygonFilter filter(image, glm::dmat3(1.0), nullptr);
  const double texel = 2.0 * pi / 2048;
  for (const int x : {2, 700, 2047}) {
    const glm::dvec3 d = direction_from_map((x + 1.25) / 2048, 511.5 / 1024);
    const glm::dvec3 east(-d.y, d.x, 0.0);
    const double light = filter.light(d, 2.5 * texel * glm::normalize(east), glm::dvec3(0.0, 0.0, -texel)).x;
    const auto at = [&](int column) {
      return static_cast<double>(image.rgb[static_cast<std::size_t>(3 * (2048 * 511 + column % 2048))]);
    };
    EXPECT_NEAR(light, (at(x) + at(x + 1) + 0.5 * at(x + 2)) / 2.5, 2e-3);
  }
}

TEST(PolygonFilter, AgreesWithTheEllipticFilterOnASmoothMap) {
  const auto smooth = [](const glm::dvec3& d) {
    return glm::dvec3(1.0 + 0.5 * std::sin(3.0 * d.x), 1.0 + 0.5 * d.y * d.z, 1.0 + 0.5 * std::cos(4.0 * d.z));
  };
  const PolygonFilter polygons(image_of(2048, smooth), glm::dmat3(1.0), nullptr);
  const SkyCube cube(Backend::cpu, 128, [&](const glm::dvec3& d) { return glm::vec3(smooth(d)); });
  std::mt19937 random(6);
  // The sky filters are a Gaussian and a box. In pixels wider than these, their results differ.
  for (const double a : {1e-4, 0.01, 0.03, 0.1}) {
    for (const double b : {1e-4, 0.01, 0.03, 0.1}) {
      for (int i = 0; i < 100; ++i) {
        const Footprint footprint = random_footprint(random_direction(random), a, b, random);
        const auto narrow = [](const glm::dvec3& v) {
          return Vector3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        };
        const SkyLight<float> ellipse = filter_sky(cube.view(), narrow(footprint.direction), narrow(footprint.along_x),
                                                   narrow(footprint.along_y), 1.0F);
        const glm::dvec4 light = seen(polygons, footprint);
        for (int part = 0; part < 3; ++part) {
          EXPECT_NEAR(light[part] / static_cast<double>(quad_part(ellipse.pixel[0], part)), 1.0, 0.03) << a << " " << b;
        }
      }
    }
  }
}

TEST(PolygonFilter, PixelsThatTileTheSkyHaveAllItsLight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  const EnvironmentImage image =
      image_of(512, [&](const glm::dvec3&) { return glm::dvec3(std::pow(uniform(random), 8.0), 1.0, 0.0); });
  const PolygonFilter filter(image, glm::dmat3(1.0), nullptr);
  // The pixels are those of the faces of a cube.
  constexpr int across = 40;
  double light = 0.0;
  double area = 0.0;
  for (int i = 0; i < 6 * across * across; ++i) {
    const double side = i / across / across % 2 == 0 ? 1.0 : -1.0;
    const double x = 2.0 * (i % across + 0.5) / across - 1.0;
    const double y = 2.0 * (i / across % across + 0.5) / across - 1.0;
    const int face = i / across / across / 2;
    const auto placed = [&](double first, double second, double main) {
      glm::dvec3 v(main, first, second);
      return face == 0 ? v : face == 1 ? glm::dvec3(v.y, v.x, v.z) : glm::dvec3(v.y, v.z, v.x);
    };
    const glm::dvec3 raw = placed(x, y, side);
    const glm::dvec3 d = glm::normalize(raw);
    const auto tangent = [&](const glm::dvec3& step) {
      return (2.0 / across / glm::length(raw)) * (step - glm::dot(step, d) * d);
    };
    const Footprint footprint = {d, tangent(placed(1.0, 0.0, 0.0)), tangent(placed(0.0, 1.0, 0.0))};
    const double solid_angle = glm::length(glm::cross(footprint.along_x, footprint.along_y));
    light += solid_angle * seen(filter, footprint).x;
    area += solid_angle;
  }
  EXPECT_NEAR(area, 4.0 * pi, 0.005);
  EXPECT_NEAR(light / area / filter.mean().x, 1.0, 0.005);
}

TEST(PolygonFilter, WhatIsTooWideOrNotANumberSeesTheMean) {
  const PolygonFilter filter(image_of(64, [](const glm::dvec3& d) { return 1.0 + d; }), glm::dmat3(1.0), nullptr);
  const glm::dvec3 d(1.0, 0.0, 0.0);
  EXPECT_NEAR(filter.mean().z, 1.0, 1e-6);
  EXPECT_EQ(filter.light(d, {0.0, 3.0, 0.0}, {0.0, 0.0, 1e-3}).z, filter.mean().z);
  EXPECT_EQ(filter.light(d, glm::dvec3(1e3), glm::dvec3(1e3)).x, filter.mean().x);
  EXPECT_EQ(filter.light(d, glm::dvec3(std::nan("")), glm::dvec3(0.0)).x, filter.mean().x);
}

}  // namespace
}  // namespace ergodome
