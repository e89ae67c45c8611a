#include "render/passes/sky/image_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <span>
#include <vector>

#include "content/sky/sky_map.h"

namespace ergodome {
namespace {

//! Returns the distance between two columns of a map as a fraction of its width. The left and right
//! edges are adjacent.
double columns_apart(double a, double b) { return std::abs(a - b - std::round(a - b)); }

//! Returns rows of directions on the faces of a cube, and rows across its axes, where the arc
//! tangent jumps.
std::vector<DirectionRow> rows_of_all_kinds(std::span<const float> s) {
  std::vector<DirectionRow> rows;
  for (const double side : {-1.0, 1.0}) {
    for (const double t : {-1.0, -0.3, 0.0, 1e-4, 0.7}) {
      rows.push_back({{side, 0.0, t}, {0.0, 1.0, 0.0}, s});
      rows.push_back({{0.0, side, t}, {1.0, 0.0, 0.0}, s});
      rows.push_back({{0.0, t, side}, {1.0, 0.0, 0.0}, s});
    }
  }
  return rows;
}

std::vector<float> evenly(int count) {
  std::vector<float> s;
  s.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    s.push_back(-1.0F + 2.0F * static_cast<float>(i) / static_cast<float>(count - 1));
  }
  return s;
}

TEST(PositionsInMap, AreThoseOfSingleDirections) {
  const std::vector<float> s = evenly(1001);
  std::vector<float> x(s.size());
  std::vector<float> y(s.size());
  for (const DirectionRow& row : rows_of_all_kinds(s)) {
    positions_in_map(row, x, y);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const glm::dvec3 d = glm::normalize(row.base + static_cast<double>(s[i]) * row.along);
      const glm::dvec2 position = map_from_direction(d);
      // Near a pole, all columns are close together, so the difference is reduced accordingly.
      ASSERT_LT(columns_apart(x[i], position.x) * std::hypot(d.x, d.y), 2e-7) << d.x << ' ' << d.y << ' ' << d.z;
      ASSERT_NEAR(y[i], position.y, 2e-7) << d.x << ' ' << d.y << ' ' << d.z;
      ASSERT_GE(x[i], -0.25F);
      ASSERT_LE(x[i], 0.75F);
    }
  }
}

EnvironmentImage noise(int width) {
  EnvironmentImage image;
  image.width = width;
  image.height = width / 2;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> light(0.0F, 1.0F);
  for (int i = 0; i < 3 * image.width * image.height; ++i) {
    image.rgb.push_back(light(random));
  }
  return image;
}

glm::dvec3 texel_of(const EnvironmentImage& image, long x, long y) {
  const long column = (x + image.width) % image.width;
  const long line = std::clamp(y, 0L, image.height - 1L);
  const auto at = 3 * static_cast<std::size_t>(line * image.width + column);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

glm::dvec3 light_between_texels(const EnvironmentImage& image, const glm::dvec3& direction) {
  const glm::dvec2 position = map_from_direction(direction);
  const double x = position.x * image.width - 0.5;
  const double y = position.y * image.height - 0.5;
  const auto left = static_cast<long>(std::floor(x));
  const auto upper = static_cast<long>(std::floor(y));
  return glm::mix(glm::mix(texel_of(image, left, upper), texel_of(image, left + 1, upper), x - std::floor(x)),
                  glm::mix(texel_of(image, left, upper + 1), texel_of(image, left + 1, upper + 1), x - std::floor(x)),
                  y - std::floor(y));
}

TEST(ImageRows, OfATurnedMapAreItsLightBetweenTexelsOverSeamAndPoles) {
  const EnvironmentImage image = noise(64);
  const std::vector<float> s = evenly(401);
  std::vector<glm::vec3> light(s.size());
  for (const double angle : {0.0, 1.1}) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))));
    const ImageRows rows(image, turn);
    for (const DirectionRow& row : rows_of_all_kinds(s)) {
      rows.read(row, light);
      for (std::size_t i = 0; i < s.size(); ++i) {
        const glm::dvec3 d = glm::normalize(turn * (row.base + static_cast<double>(s[i]) * row.along));
        if (std::hypot(d.x, d.y) > 1e-3) {
          ASSERT_LT(glm::length(glm::dvec3(light[i]) - light_between_texels(image, d)), 1e-3)
              << d.x << ' ' << d.y << ' ' << d.z;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
