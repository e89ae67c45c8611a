#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "kernels/core/arithmetic.h"
#include "kernels/core/lanes.h"
#include "kernels/core/quad.h"
#include "kernels/launch/launch.h"
#include "kernels/spacetime/trace/trace_rays.h"

namespace ergodome {
namespace {

template <class T>
class Arithmetic : public testing::Test {};
using RealTypes = testing::Types<float, double, WidePack<float>, WidePack<double>>;
TYPED_TEST_SUITE(Arithmetic, RealTypes);

TYPED_TEST(Arithmetic, SineAndCosineAreThoseOfTheStandardLibrary) {
  using S = ScalarOf<TypeParam>;
  const double epsilon = std::numeric_limits<S>::epsilon();
  for (double angle = -400.0; angle <= 400.0; angle += 0.37) {
    TypeParam sine;
    TypeParam cosine;
    sine_cosine(TypeParam(static_cast<S>(angle)), sine, cosine);
    const double exact = static_cast<double>(static_cast<S>(angle));
    const double tolerance = 4.0 * epsilon + 2e-10 * epsilon * std::abs(angle);
    ASSERT_NEAR(static_cast<double>(lane(sine, 0)), std::sin(exact), tolerance) << angle;
    ASSERT_NEAR(static_cast<double>(lane(cosine, 0)), std::cos(exact), tolerance) << angle;
  }
}

TYPED_TEST(Arithmetic, RoughPowerIsWithinATenth) {
  using S = ScalarOf<TypeParam>;
  for (const double base : {1e-12, 3e-7, 0.1, 1.0, 17.0, 1e6}) {
    for (const double exponent : {0.05, 0.1, 0.125, 0.5, 1.0}) {
      const TypeParam power = rough_power(TypeParam(static_cast<S>(base)), static_cast<S>(exponent));
      EXPECT_NEAR(static_cast<double>(lane(power, 0)) / std::pow(base, exponent), 1.0, 0.1) << base << "^" << exponent;
    }
  }
}

TYPED_TEST(Arithmetic, SafeSquareRootOfANegativeNumberIsZero) {
  using S = ScalarOf<TypeParam>;
  EXPECT_EQ(lane(safe_sqrt(TypeParam(S(-1e-20))), 0), S(0));
  EXPECT_EQ(lane(safe_sqrt(TypeParam(S(4))), 0), S(2));
}

TYPED_TEST(Arithmetic, LoadingPastTheEndRepeatsTheLastElementAndStoringKeepsOff) {
  using S = ScalarOf<TypeParam>;
  constexpr int lanes = RealTraits<TypeParam>::lane_count;
  if constexpr (lanes > 1) {
    std::array<S, 2 * lanes> from{};
    std::iota(from.begin(), from.end(), S(0));
    const int count = lanes + 1;
    const TypeParam value = load_lanes<TypeParam>(from.data(), lanes, count);
    EXPECT_EQ(lane(value, 0), S(lanes));
    EXPECT_EQ(lane(value, lanes - 1), S(lanes));
    std::array<S, 2 * lanes> to{};
    store_lanes(to.data(), lanes, count, TypeParam(S(7)));
    EXPECT_EQ(to[lanes], S(7));
    EXPECT_EQ(to[lanes + 1], S(0));
  }
}

TYPED_TEST(Arithmetic, ChosenLanesAreWrittenOneAfterAnother) {
  using S = ScalarOf<TypeParam>;
  constexpr int lanes = RealTraits<TypeParam>::lane_count;
  if constexpr (std::is_same_v<S, float>) {
    for (unsigned bits = 1; bits < 1U << static_cast<unsigned>(lanes); ++bits) {
      std::array<float, lanes> to{};
      const ChosenLanes<TypeParam> chosen(bits);
      chosen.store(to.data(), lane_numbers<TypeParam>());
      ASSERT_EQ(chosen.count(), std::popcount(bits));
      int next = 0;
      for (int i = 0; i < lanes; ++i) {
        if ((bits >> static_cast<unsigned>(i) & 1U) != 0) {
          ASSERT_EQ(to[static_cast<std::size_t>(next)], static_cast<float>(i));
          ++next;
        }
      }
    }
  }
}

//! Returns the sky directions of some rays, traced by the kernels for one instruction set.
std::vector<double> sky_of(InstructionSet set) {
  constexpr int count = 1003;
  std::array<std::vector<double>, 3> n;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < count; ++i) {
    Vector3<double> v = {normal(random), normal(random), normal(random)};
    v = (1.0 / std::sqrt(dot(v, v))) * v;
    n[0].push_back(v.x);
    n[1].push_back(v.y);
    n[2].push_back(v.z);
  }
  std::vector<double> sky(3 * count);
  RayBatch<double> batch{};
  batch.camera = make_camera_station(Spacetime{0.999}, 5.0, 1.3, 0.4, ObserverMotion::geodesic);
  batch.settings = {1e-12, 1000};
  batch.method = TraceMethod::taylor;
  batch.count = count;
  for (std::size_t i = 0; i < 3; ++i) {
    batch.direction[i] = n[i].data();
    batch.sky[i] = sky.data() + i * count;
  }
  const auto kernel = cpu_kernel<RayBatch<double>>(set);
  kernel.run(batch, 0, kernel.calls(batch));
  return sky;
}

TEST(HalfQuads, DecodeEveryFiniteHalfFloat) {
  // Each finite half float, from its definition: a sign, 5 bits of exponent, 10 of mantissa.
  for (std::uint32_t bits = 0; bits < 0x10000U; ++bits) {
    const int exponent = static_cast<int>(bits >> 10U & 31U);
    if (exponent == 31) {
      continue;
    }
    const auto mantissa = static_cast<float>(bits & 1023U) + (exponent == 0 ? 0.0F : 1024.0F);
    const float value = std::ldexp((bits & 0x8000U) != 0 ? -mantissa : mantissa, std::max(exponent, 1) - 25);
    const HalfQuad quad = {{0, static_cast<std::uint16_t>(bits), 0x3c00, 0}};
    ASSERT_EQ(quad_part(load_quad(&quad), 1), value) << bits;
    ASSERT_EQ(quad_part(load_quad(&quad), 2), 1.0F);
  }
}

TEST(InstructionSets, GiveTheSameSky) {
  const std::vector<double> portable = sky_of(InstructionSet::portable);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (!has_instruction_set(set)) {
      continue;
    }
    const std::vector<double> other = sky_of(set);
    for (std::size_t i = 0; i < portable.size(); ++i) {
      ASSERT_NEAR(portable[i], other[i], 1e-9) << name_of(set) << " element " << i;
    }
  }
}

TEST(InstructionSets, EveryProcessorHasThePortableOne) {
  EXPECT_TRUE(has_instruction_set(InstructionSet::portable));
  EXPECT_TRUE(has_instruction_set(active_instruction_set()));
}

}  // namespace
}  // namespace ergodome
