#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "render/accuracy/accuracy.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/axes/picture_race.h"
#include "tests/render/accuracy/accuracy_scene.h"
#include "tests/support/gl_driver.h"
#include "tests/support/sanitized.h"

// Hook of LeakSanitizer: disables its reports if a test loaded an OpenGL driver (gl_driver.h).
// NOLINTNEXTLINE: LeakSanitizer prescribes the name
extern "C" int __lsan_is_turned_off() { return ergodome::test::driver_was_loaded ? 1 : 0; }

namespace ergodome {
namespace {

Show two_eyed(double baseline) {
  Show show = test::small_dome("[stereo]\nlayout = \"side_by_side\"\nmodel = \"physical\"\n");
  show.stereo.baseline = baseline;
  return show;
}

AccuracyAxis stereo_of(const Show& show) {
  AccuracySettings settings = test::few();
  settings.size_px = 96;
  settings.lattice = 48;
  return measure_stereo(show, PixelNeed::sky, accuracy_moments(show, settings), settings, {}).value();
}

const Measurement& choice_of(const AccuracyAxis& axis, const std::string& method, const std::string& setting) {
  const auto found = std::ranges::find_if(axis.choices, [&](const Measurement& choice) {
    return choice.method == method && choice.setting.starts_with(setting);
  });
  EXPECT_NE(found, axis.choices.end()) << method << ", " << setting;
  return *found;
}

Show with_near_things(const std::string& more, double spin) {
  Show show = test::small_dome(more);
  show.spin = spin;
  show.camera.keys.front().r = 20.0;
  show.view.field_of_view_deg = 90.0;
  show.view.tilt_deg = 90.0;
  return show;
}

AccuracyAxis near_of(const Show& show) {
  AccuracySettings settings = test::few();
  settings.size_px = test::sanitized ? 48 : 96;
  settings.lattice = settings.size_px;
  return measure_near(show, settings, {});
}

constexpr const char* small_sphere =
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nsize = 2\nsegments = 12\nrings = 6\nposition = [-7, -3.2, "
    "0]\n"
    "checker = { columns = 8, rows = 4, dark = 0.2 }\n";

TEST(StereoAxis, OfAnEyeThatIsACameraStaysWithinItsBudget) {
  const AccuracyAxis axis = stereo_of(two_eyed(0.5));
  EXPECT_LT(choice_of(axis, "physical", "grid").error.p99, 0.25);
  EXPECT_LT(choice_of(axis, "physical", "direct").error.p99, 0.05);
}

TEST(StereoAxis, OfTheFlatModelMissesByTheLensesParallaxWhichGrowsWithTheBaseline) {
  const double near_eyes = choice_of(stereo_of(two_eyed(0.05)), "flat", "direct").error.median;
  const double far_eyes = choice_of(stereo_of(two_eyed(0.1)), "flat", "direct").error.median;
  EXPECT_NEAR(far_eyes / near_eyes, 2.0, 0.1);
}

TEST(StereoAxis, OfTurningEyesIsRightInFrontAndMissesElsewhere) {
  const AccuracyAxis axis = stereo_of(two_eyed(0.1));
  const Measurement& omni = choice_of(axis, "omni", "direct");
  double in_front = 0.0;
  double beside = 0.0;
  const int middle = omni.map.width / 2;
  for (int row = 2 * omni.map.height / 3; row < 4 * omni.map.height / 5; ++row) {
    const auto error_at = [&](int column) {
      const double error =
          static_cast<double>(omni.map.error[static_cast<std::size_t>(row) * static_cast<std::size_t>(omni.map.width) +
                                             static_cast<std::size_t>(column)]);
      return std::isnan(error) ? 0.0 : error;
    };
    in_front = std::max(in_front, error_at(middle));
    beside = std::max(beside, error_at(middle / 4));
  }
  EXPECT_LT(in_front, 0.2 * beside);
}

TEST(StereoAxis, IsOfShowsWithTwoEyesAlone) {
  AccuracySettings settings = test::few();
  settings.axes = {"stereo"};
  EXPECT_TRUE(accuracy_axes(test::small_dome(), settings).empty());
  EXPECT_EQ(accuracy_axes(two_eyed(0.1), settings).size(), 1U);
}

TEST(StereoAxis, IsNotThereWhereTheEyesAreAtOnePlace) {
  const AccuracySettings settings = test::few();
  const Show show = two_eyed(0.0);
  EXPECT_FALSE(measure_stereo(show, PixelNeed::sky, accuracy_moments(show, settings), settings, {}));
}

TEST(NearAxis, OfADiskGetsBetterWithTheBudget) {
  const AccuracyAxis axis = near_of(with_near_things("[disk]\nouter = 12\n", 0.9));
  ASSERT_EQ(axis.choices.size(), 2U);
  EXPECT_EQ(axis.choices[0].method, "rays");
  EXPECT_GT(axis.choices[0].error.count, 100U);
  EXPECT_LE(axis.choices[1].error.p99, axis.choices[0].error.p99);
  EXPECT_LT(axis.choices[1].error.p99, 0.05);
}

TEST(NearAxis, OfObjectsNearASpinningHoleHasRaysAlone) {
  AccuracySettings settings = test::few();
  settings.size_px = 32;
  const AccuracyAxis axis = measure_near(with_near_things(small_sphere, 0.5), settings, {});
  EXPECT_EQ(axis.choices.size(), 2U);
}

TEST(NearAxis, OfObjectsWithoutSpinHasPolygonsWhichAreTheNearerTheMoreTheyAreDivided) {
  test::driver_was_loaded = true;
  const AccuracyAxis axis = near_of(with_near_things(small_sphere, 0.0));
  ASSERT_EQ(axis.choices.size(), 5U);
  EXPECT_EQ(axis.choices[2].published, "MSW");
  const auto mean_of_errors = [](const Measurement& choice) {
    double sum = 0.0;
    for (const float error : choice.map.error) {
      sum += std::isnan(error) ? 0.0 : static_cast<double>(error);
    }
    return sum;
  };
  EXPECT_LT(mean_of_errors(axis.choices[4]), mean_of_errors(axis.choices[2]));
}

}  // namespace
}  // namespace ergodome
