#include "render/accuracy/lenses/lens_race.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "kernels/core/error.h"
#include "tests/render/accuracy/accuracy_scene.h"
#include "tests/support/errors.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

std::vector<Measurement> measured(const std::vector<LensChoiceToMeasure>& choices, PixelNeed need = PixelNeed::sky,
                                  const AccuracySettings& settings = test::few()) {
  return measure_lenses(choices, need, accuracy_moments(test::small_dome(), settings), settings, {});
}

TEST(LensRace, TheReferenceMethodMissesByNothing) {
  const Measurement closed = measured({ray_choice(TraceMethod::closed_form, false, 0.0)}).front();
  EXPECT_GT(closed.error.count, 100U);
  EXPECT_LT(closed.error.largest, 1e-7);
  EXPECT_EQ(closed.lost, 0.0);
  EXPECT_LT(closed.flicker.value(), 1e-7);
}

TEST(LensRace, ALooserToleranceMissesByMore) {
  for (const TraceMethod method : {TraceMethod::taylor, TraceMethod::rk34}) {
    const std::vector<Measurement> results =
        measured({ray_choice(method, false, 1e-6), ray_choice(method, false, 1e-4), ray_choice(method, false, 1e-2)});
    EXPECT_LT(3.0 * results[0].error.p99, results[1].error.p99) << results[0].method;
    EXPECT_LT(3.0 * results[1].error.p99, results[2].error.p99) << results[0].method;
    EXPECT_LT(results[0].flicker.value(), results[2].flicker.value()) << results[0].method;
  }
}

TEST(LensRace, ALooserToleranceMissesByMoreInThePublishedEquationsToo) {
  const std::vector<Measurement> results = measured(
      {ray_choice(TraceMethod::baseline_rk34, false, 1e-4), ray_choice(TraceMethod::baseline_rk34, false, 1e-2)});
  EXPECT_LT(3.0 * results[0].error.p99, results[1].error.p99);
}

TEST(LensRace, AFinerQuadtreeMissesByLess) {
  constexpr int finest_level = test::sanitized ? 9 : 10;
  const std::vector<Measurement> results =
      measured({quadtree_choice(7, true), quadtree_choice(finest_level, true), quadtree_pixel_choice(finest_level)});
  EXPECT_LT(results[1].error.p99, results[0].error.p99);
  EXPECT_GT(results[1].memory_bytes, 0U);
  // Result 2 is read from the same grid as result 1, but in float and by different code.
  EXPECT_NEAR(results[2].error.median, results[1].error.median, 1e-3);
}

TEST(LensRace, AConformingGridHoldsItsBudgetForMostPixels) {
  const std::vector<Measurement> results = measured({grid_choice(1.0), grid_choice(0.1)}, PixelNeed::footprint);
  EXPECT_LT(results[0].error.p99, 1.5);
  EXPECT_LT(results[1].error.p99, 0.15);
  EXPECT_GT(results[1].disk_bytes.value(), 0U);
}

TEST(LensRace, ErrorsAreTheSameInAnotherRun) {
  const std::vector<LensChoiceToMeasure> choices = {grid_choice(0.25), direct_choice(0.05), quadtree_choice(8, false)};
  const std::vector<Measurement> first = measured(choices);
  const std::vector<Measurement> second = measured(choices);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    EXPECT_EQ(first[i].error.p99, second[i].error.p99) << first[i].method;
    EXPECT_EQ(first[i].error.largest, second[i].error.largest) << first[i].method;
    EXPECT_EQ(first[i].memory_bytes, second[i].memory_bytes) << first[i].method;
  }
}

TEST(LensRace, EveryRoundTimesEveryChoice) {
  AccuracySettings settings = test::few();
  settings.rounds = 3;
  for (const Measurement& result : measured({grid_choice(1.0), direct_choice(0.05)}, PixelNeed::sky, settings)) {
    EXPECT_EQ(result.frame_ms.size(), 3U);
    EXPECT_EQ(result.prepare_ms.size(), 3U);
    EXPECT_THAT(result.anew_ms(), testing::Each(testing::Gt(0.0)));
  }
}

TEST(LensRace, TheErrorMapHasAValueForEachComparedPixel) {
  const Measurement result = measured({direct_choice(0.05)}).front();
  EXPECT_EQ(result.map.width, 16);
  EXPECT_EQ(result.map.error.size(), 256U);
  const auto known = std::ranges::count_if(result.map.error, [](float error) { return error >= 0.0F; });
  EXPECT_EQ(static_cast<std::size_t>(known), result.error.count);
}

TEST(LensRace, StopsWhenItIsTold) {
  const AccuracySettings settings = test::few();
  const auto run = [&] {
    measure_lenses({direct_choice(0.05)}, PixelNeed::sky, accuracy_moments(test::small_dome(), settings), settings,
                   [](const std::string&) { return false; });
  };
  EXPECT_THAT(test::error_of(run), testing::HasSubstr("stopped"));
}

TEST(LensRace, TheChoicesHoldThePublishedMethods) {
  std::set<std::string> published;
  for (const LensChoiceToMeasure& choice : sky_choices(true)) {
    published.insert(choice.method + " " + choice.published);
  }
  for (const char* const name : {"quadtree, spline VE", "cash_karp MSW, VE", "rk34 RK34", "baseline_rk34 RK34"}) {
    EXPECT_TRUE(published.contains(name)) << name;
  }
}

}  // namespace
}  // namespace ergodome
