#include "render/passes/sky/sky_cube.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <utility>
#include <vector>

#include "content/sky/sky_map.h"
#include "kernels/sky/elliptic_filter.h"

namespace ergodome {
namespace {

Vector3<float> narrow(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

//! Returns the filtered light of a pixel with the given direction and footprint.
Vector3<float> filtered(const CubeMap& map, const Vector3<float>& d, const Vector3<float>& along_x,
                        const Vector3<float>& along_y) {
  const SkyLight<float> light = filter_sky(map, d, along_x, along_y, 1.0F);
  return {quad_part(light.pixel[0], 0), quad_part(light.pixel[0], 1), quad_part(light.pixel[0], 2)};
}

//! Returns the filtered light of a pixel in direction d with angular sizes a and b [rad]; `turn`
//! rotates its axes.
Vector3<float> seen_at(const CubeMap& map, const glm::dvec3& d, double a, double b, double turn = 0.3) {
  const glm::dvec3 axis = std::abs(d.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 e1 = glm::normalize(glm::cross(axis, d));
  const glm::dvec3 e2 = glm::cross(d, e1);
  return filtered(map, narrow(d), narrow(a * (std::cos(turn) * e1 + std::sin(turn) * e2)),
                  narrow(b * (std::cos(turn) * e2 - std::sin(turn) * e1)));
}

glm::dvec3 random_sky_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

//! Returns a sky whose light is a linear function of the cosine of the angle to an axis, so that
//! all averages over small footprints are known.
SkyCube dipole_sky(int size = 64) {
  return {Backend::cpu, size,
          [](const glm::dvec3& d) { return glm::vec3(1.0 + 0.5 * d.x, 1.0 + 0.5 * d.y, 1.0 + 0.5 * d.z); }};
}

TEST(SkyCube, ConstantSkyStaysConstantForEveryFootprint) {
  const SkyCube sky(Backend::cpu, 32, [](const glm::dvec3&) { return glm::vec3(0.25F, 0.5F, 2.0F); });
  std::mt19937 random(1);
  for (const double a : {1e-5, 1e-2, 0.3, 3.0, 1e4}) {
    for (const double b : {1e-7, 1e-3, 0.1}) {
      const Vector3<float> light = seen_at(sky.view(), random_sky_direction(random), a, b);
      EXPECT_NEAR(light.x, 0.25F, 1e-6F);
      EXPECT_NEAR(light.z, 2.0F, 1e-5F);
    }
  }
}

TEST(SkyCube, SmallFootprintSeesTheLightOfItsDirection) {
  const SkyCube sky = dipole_sky();
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = random_sky_direction(random);
    const Vector3<float> light = seen_at(sky.view(), d, 1e-3, 1e-3);
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
  // Compares adjacent samples on great circles across the edges of the cube, its corners and the
  // poles. They must not differ by more than inside a face.
  const auto largest_jump = [&](const glm::dvec3& from, const glm::dvec3& across, double footprint) {
    double jump = 0.0;
    Vector3<float> last{};
    for (int i = 0; i <= 4000; ++i) {
      const double angle = (i - 2000) * 1e-5;
      const Vector3<float> light =
          seen_at(sky.view(), glm::normalize(std::cos(angle) * from + std::sin(angle) * across), footprint, footprint);
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
    // The seam of the map from which the cube is made is at right ascension 90°.
    EXPECT_LT(largest_jump(glm::normalize(glm::dvec3(0.0, 1.0, 0.1)), glm::dvec3(1.0, 0.0, 0.0), footprint), limit);
  }
}

TEST(SkyCube, FootprintAsWideAsTheSkySeesItsMean) {
  const SkyCube sky = dipole_sky();
  const Vector3<float> light = seen_at(sky.view(), {1.0, 0.0, 0.0}, 50.0, 1e-3);
  EXPECT_NEAR(light.x, 1.0, 2e-3);
  EXPECT_NEAR(light.y, 1.0, 2e-3);
}

TEST(SkyCube, FootprintThatIsNotANumberSeesTheMean) {
  const SkyCube sky = dipole_sky();
  const float nan = std::nanf("");
  const Vector3<float> light = filtered(sky.view(), {1.0F, 0.0F, 0.0F}, {nan, 0.0F, 0.0F}, {0.0F, nan, 0.0F});
  EXPECT_NEAR(light.x, 1.0F, 2e-3F);
}

TEST(SkyCube, KeepsTheLightOfBrightAndDarkSkies) {
  // Texels are half floats; the range of light must not matter, nor that one texel is very bright.
  for (const float brightest : {1e-27F, 1e-6F, 1.0F, 1e9F, 1e30F}) {
    for (const float part : {0.7F, 3e-3F, 5e-6F, 5e-9F}) {
      const SkyCube sky(Backend::cpu, 8, [&](const glm::dvec3& d) {
        return glm::vec3(d.x < -0.9 ? brightest : brightest * part, brightest * part, 0.0F);
      });
      const Vector3<float> light = filtered(sky.view(), {1.0F, 0.0F, 0.0F}, {0.0F, 1e-3F, 0.0F}, {0.0F, 0.0F, 1e-3F});
      EXPECT_NEAR(light.x / (brightest * part), 1.0F, 0x1p-11F) << brightest << " " << part;
      EXPECT_NEAR(light.y / (brightest * part), 1.0F, 0x1p-11F) << brightest << " " << part;
      EXPECT_EQ(light.z, 0.0F);
    }
  }
}

TEST(SkyCube, StaysFiniteWithHardlyAnyLight) {
  const SkyCube sky(Backend::cpu, 4, [&](const glm::dvec3&) { return glm::vec3(1e-44F, 0.0F, 0.0F); });
  const Vector3<float> light = filtered(sky.view(), {1.0F, 0.0F, 0.0F}, {0.0F, 1e-3F, 0.0F}, {0.0F, 0.0F, 1e-3F});
  EXPECT_LT(light.x, 1e-40F);
  EXPECT_EQ(light.y, 0.0F);
}

TEST(SkyCube, WholeSkyKeepsItsLight) {
  // The light, averaged over the sphere, must be the same on every level of the mip chain.
  const SkyCube sky(Backend::cpu, 64, [](const glm::dvec3& d) {
    return glm::vec3(d.z > 0.9 ? 50.0 : 0.0, d.x > 0.99 ? 1000.0 : 0.0, d.x * d.x);
  });
  const Vector3<float> mean = cube_mean(sky.view());
  EXPECT_NEAR(mean.x, 50.0 * 0.05, 0.05);  // a cap of height h covers h / 2 of the sphere
  EXPECT_NEAR(mean.y, 1000.0 * 0.005, 0.2);
  EXPECT_NEAR(mean.z, 1.0 / 3.0, 2e-3);
}

//! A sky that is a sum of plane waves cos(k d + phase). For each wave, the average over a small
//! Gaussian footprint is known.
class WavySky {
 public:
  //! Creates waves with wavelengths down to 2 pi / wave_number [rad].
  WavySky(double wave_number, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 40; ++i) {
      const double length = wave_number * (0.4 + 0.6 * uniform(random));
      waves_.push_back({length * random_sky_direction(random), 6.28 * uniform(random)});
    }
  }

  //! Returns the average over a Gaussian footprint. a and b are its half axes (standard
  //! deviations).
  [[nodiscard]] double light(const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b) const {
    double sum = 0.0;
    for (const auto& [k, phase] : waves_) {
      const double along_a = glm::dot(k, a);
      const double along_b = glm::dot(k, b);
      sum += std::cos(glm::dot(k, d) + phase) * std::exp(-0.5 * (along_a * along_a + along_b * along_b));
    }
    return 1.0 + sum / static_cast<double>(waves_.size());
  }

 private:
  std::vector<std::pair<glm::dvec3, double>> waves_;
};

//! Returns the root-mean-square error of the sky filter for footprints of the same shape all over
//! the sky. `minor` is the small half axis [rad], `ratio` the ratio of both.
double filter_error(const SkyCube& sky, const WavySky& wavy, double minor, double ratio, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform;
  double squared = 0.0;
  constexpr int count = 1000;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 d = random_sky_direction(random);
    const glm::dvec3 a = 0.5 * ratio * minor * glm::normalize(glm::cross(d, random_sky_direction(random)));
    const glm::dvec3 b = glm::cross(d, a) / ratio;
    const Vector3<float> seen = filtered(sky.view(), narrow(d), narrow(2.0 * a), narrow(2.0 * b));
    squared += std::pow(seen.x - wavy.light(d, a, b), 2);
  }
  return std::sqrt(squared / count);
}

TEST(SkyCube, EllipticFootprintIsTheGaussianAverageOfTheMap) {
  // Texels are 6 mrad wide, and wavelengths are at least 60 mrad. Footprints are smaller than a
  // texel, as large as one and larger. For comparison, the sky varies by 0.11.
  std::mt19937 random(3);
  const WavySky wavy(100.0, random);
  const SkyCube sky(Backend::cpu, 256,
                    [&](const glm::dvec3& d) { return glm::vec3(static_cast<float>(wavy.light(d, {}, {}))); });
  for (const double ratio : {1.0, 1.1, 1.4, 2.0, 3.0, 5.0, 8.0}) {
    EXPECT_LT(filter_error(sky, wavy, 0.003, ratio, random), 0.002) << ratio;
    EXPECT_LT(filter_error(sky, wavy, 0.010, ratio, random), 0.004) << ratio;
    EXPECT_LT(filter_error(sky, wavy, 0.020, ratio, random), 0.009) << ratio;
  }
}

TEST(SkyCube, PacksOfPixelsSeeWhatSinglePixelsSee) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  const WavySky wavy(100.0, random);
  const SkyCube sky(Backend::cpu, 64,
                    [&](const glm::dvec3& d) { return glm::vec3(static_cast<float>(wavy.light(d, {}, {}))); });
  using Lanes = Pack<float, 4>;
  for (int round = 0; round < 500; ++round) {
    Vector3<Lanes> d;
    Vector3<Lanes> x;
    Vector3<Lanes> y;
    Lanes factor;
    std::array<Vector3<float>, 4> alone{};
    for (int i = 0; i < 4; ++i) {
      // Adjacent lanes of a SIMD pack have different kinds of footprints: none, pixels of any
      // shape, wider than the whole sky, NaN.
      const float size = round % 50 == i ? std::nanf("") : std::pow(10.0F, 2.5F * uniform(random) - 2.0F);
      const Vector3<float> di = narrow(random_sky_direction(random));
      const Vector3<float> xi = size * Vector3<float>{uniform(random), uniform(random), uniform(random)};
      const Vector3<float> yi = size * Vector3<float>{uniform(random), uniform(random), uniform(random)};
      const float fi = round % 3 == 0 && i == 2 ? 0.0F : 1.0F;
      const auto set = [i](Vector3<Lanes>& to, const Vector3<float>& from) {
        set_lane(to.x, i, from.x);
        set_lane(to.y, i, from.y);
        set_lane(to.z, i, from.z);
      };
      set(d, di);
      set(x, xi);
      set(y, yi);
      set_lane(factor, i, fi);
      alone[static_cast<std::size_t>(i)] = fi * filtered(sky.view(), di, xi, yi);
    }
    const SkyLight<Lanes> light = filter_sky(sky.view(), d, x, y, factor);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(quad_part(light.pixel[i], 0), alone[static_cast<std::size_t>(i)].x, 2e-5F);
    }
  }
}

TEST(SkyCube, WarpOfTheFacesHasItsInverse) {
  for (double s = -1.0; s <= 1.0; s += 0.01) {
    EXPECT_NEAR(warped(static_cast<float>(unwarped(s))), s, 1e-6);
  }
}

}  // namespace
}  // namespace ergodome
