#include "render/sky/sky_cube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "content/sky_map.h"
#include "kernels/sky/elliptic_filter.h"

namespace ergodome {
namespace {

Vector3<float> narrow(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

//! The filter for a pixel that looks along d and spans the angles a and b across [rad].
Vector3<float> look(const CubeMap& map, const glm::dvec3& d, double a, double b, double turn = 0.3) {
  const glm::dvec3 axis = std::abs(d.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 e1 = glm::normalize(glm::cross(axis, d));
  const glm::dvec3 e2 = glm::cross(d, e1);
  return filter_sky(map, narrow(d), narrow(a * (std::cos(turn) * e1 + std::sin(turn) * e2)),
                    narrow(b * (std::cos(turn) * e2 - std::sin(turn) * e1)));
}

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

//! Light that varies as the cosine to an axis: every average over a small footprint is known.
SkyCube dipole_sky(int size = 64) {
  return {Backend::cpu, size,
          [](const glm::dvec3& d) { return glm::vec3(1.0 + 0.5 * d.x, 1.0 + 0.5 * d.y, 1.0 + 0.5 * d.z); }};
}

TEST(SkyCube, ConstantSkyStaysConstantForEveryFootprint) {
  const SkyCube sky(Backend::cpu, 32, [](const glm::dvec3&) { return glm::vec3(0.25F, 0.5F, 2.0F); });
  std::mt19937 random(1);
  for (const double a : {1e-5, 1e-2, 0.3, 3.0, 1e4}) {
    for (const double b : {1e-7, 1e-3, 0.1}) {
      const Vector3<float> light = look(sky.view(), random_direction(random), a, b);
      EXPECT_NEAR(light.x, 0.25F, 1e-6F);
      EXPECT_NEAR(light.z, 2.0F, 1e-5F);
    }
  }
}

TEST(SkyCube, SmallFootprintSeesTheLightOfItsDirection) {
  const SkyCube sky = dipole_sky();
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = random_direction(random);
    const Vector3<float> light = look(sky.view(), d, 1e-3, 1e-3);
    EXPECT_NEAR(light.x, 1.0 + 0.5 * d.x, 2e-3);
    EXPECT_NEAR(light.y, 1.0 + 0.5 * d.y, 2e-3);
    EXPECT_NEAR(light.z, 1.0 + 0.5 * d.z, 2e-3);
  }
}

TEST(SkyCube, HasNoSeamAtEdgesCornersAndPoles) {
  const SkyCube sky(Backend::cpu, load_sky_map([] {
                      Show show;
                      show.sky.map = "grid";
                      return show;
                    }()),
                    glm::dmat3(1.0));
  // Great circles through the cube's edges, its corners and the poles: neighbouring looks differ no more than across a face.
  const auto largest_jump = [&](const glm::dvec3& from, const glm::dvec3& across, double footprint) {
    double jump = 0.0;
    Vector3<float> last{};
    for (int i = 0; i <= 4000; ++i) {
      const double angle = (i - 2000) * 1e-5;
      const Vector3<float> light =
          look(sky.view(), glm::normalize(std::cos(angle) * from + std::sin(angle) * across), footprint, footprint);
      jump = i > 0 ? std::max(jump, static_cast<double>(std::abs(light.x - last.x))) : jump;
      last = light;
    }
    return jump;
  };
  const glm::dvec3 corner = glm::normalize(glm::dvec3(1.0, 1.0, 1.0));
  const glm::dvec3 edge = glm::normalize(glm::dvec3(1.0, 1.0, 0.2));
  for (const double footprint : {2e-3, 3e-2}) {
    const double limit = footprint < 0.01 ? 0.012 : 0.003;
    EXPECT_LT(largest_jump(edge, glm::normalize(glm::dvec3(-1.0, 1.0, 0.0)), footprint), limit);
    EXPECT_LT(largest_jump(corner, glm::normalize(glm::dvec3(-1.0, 1.0, 0.0)), footprint), limit);
    EXPECT_LT(largest_jump(glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 0.0), footprint), limit);
    // The source's own seam: right ascension 90°.
    EXPECT_LT(largest_jump(glm::normalize(glm::dvec3(0.0, 1.0, 0.1)), glm::dvec3(1.0, 0.0, 0.0), footprint), limit);
  }
}

TEST(SkyCube, FootprintAsWideAsTheSkySeesItsMean) {
  const SkyCube sky = dipole_sky();
  const Vector3<float> light = look(sky.view(), {1.0, 0.0, 0.0}, 50.0, 1e-3);
  EXPECT_NEAR(light.x, 1.0, 2e-3);
  EXPECT_NEAR(light.y, 1.0, 2e-3);
}

TEST(SkyCube, FootprintThatIsNotANumberSeesTheMean) {
  const SkyCube sky = dipole_sky();
  const float nan = std::nanf("");
  const Vector3<float> light = filter_sky(sky.view(), {1.0F, 0.0F, 0.0F}, {nan, 0.0F, 0.0F}, {0.0F, nan, 0.0F});
  EXPECT_NEAR(light.x, 1.0F, 2e-3F);
}

TEST(SkyCube, WholeSkyKeepsItsLight) {
  // The mean over the sphere is found whatever the level it is taken from.
  const SkyCube sky(Backend::cpu, 64, [](const glm::dvec3& d) {
    return glm::vec3(d.z > 0.9 ? 50.0 : 0.0, d.x > 0.99 ? 1000.0 : 0.0, d.x * d.x);
  });
  const Vector3<float> mean = cube_mean(sky.view());
  EXPECT_NEAR(mean.x, 50.0 * 0.05, 0.05);  // a cap of height h covers h / 2 of the sphere
  EXPECT_NEAR(mean.y, 1000.0 * 0.005, 0.2);
  EXPECT_NEAR(mean.z, 1.0 / 3.0, 2e-3);
}

TEST(SkyCube, EllipticFootprintIsTheGaussianAverageOfTheMap) {
  // Against a dense sum over the footprint of a smooth random map; anisotropy up to 8.
  const auto light = [](const glm::dvec3& d) {
    return static_cast<float>(1.0 + 0.4 * std::sin(11.0 * d.x + 3.0) * std::cos(13.0 * d.y) +
                              0.4 * std::sin(17.0 * d.z));
  };
  const SkyCube sky(Backend::cpu, 256, [&](const glm::dvec3& d) { return glm::vec3(light(d)); });
  std::mt19937 random(3);
  double squared = 0.0;
  int count = 0;
  for (const double ratio : {1.0, 2.0, 4.0, 8.0}) {
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 d = random_direction(random);
      const double minor = 0.03;
      const double major = ratio * minor;
      const glm::dvec3 axis = std::abs(d.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
      const glm::dvec3 e1 = glm::normalize(glm::cross(axis, d));
      const glm::dvec3 e2 = glm::cross(d, e1);
      double sum = 0.0;
      double weights = 0.0;
      for (int u = -20; u <= 20; ++u) {
        for (int v = -20; v <= 20; ++v) {
          // Standard deviation half a pixel, out to two and a half of them.
          const double x = u / 8.0;
          const double y = v / 8.0;
          const double weight = std::exp(-0.5 * (x * x + y * y));
          sum += weight * light(glm::normalize(d + 0.5 * major * x * e1 + 0.5 * minor * y * e2));
          weights += weight;
        }
      }
      const double seen = look(sky.view(), d, major, minor, 0.0).x;
      squared += std::pow(seen - sum / weights, 2);
      ++count;
    }
  }
  const double psnr_db = -10.0 * std::log10(squared / count);
  EXPECT_GT(psnr_db, 35.0);
}

TEST(SkyCube, WarpOfTheFacesHasItsInverse) {
  for (double s = -1.0; s <= 1.0; s += 0.01) {
    EXPECT_NEAR(warped(static_cast<float>(unwarped(s))), s, 1e-6);
  }
}

}  // namespace
}  // namespace ergodome
