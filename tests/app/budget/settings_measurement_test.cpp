#include "app/budget/settings_measurement.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "app/budget/budget_choice.h"
#include "app/budget/budget_texts.h"
#include "app/budget/lens_error.h"
#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "tests/render/accuracy/accuracy_scene.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

//! Returns a show whose camera falls towards a fast-spinning hole.
Show falling_show() {
  Show show = test::small_dome();
  show.duration_s = 10.0;
  CameraKey near = show.camera.keys.front();
  near.time_s = 10.0;
  near.r = 3.0;
  show.camera.keys.push_back(near);
  return show;
}

MeasurementOrder order_for(const Budget& budget, LensChoice lens) {
  MeasurementOrder order;
  order.budget = budget;
  order.size_px = test::sanitized ? 256 : 400;
  order.lens = lens;
  // The time limit is so large that the result does not depend on the speed of the machine.
  order.limit_s = 1e6;
  return order;
}

TEST(SettingsMeasurement, LooksWhereTheCameraIsNearestFirst) {
  const std::vector<double> times_s = budget_times(falling_show(), 4);
  ASSERT_EQ(times_s.size(), 4U);
  EXPECT_EQ(times_s.front(), 10.0);
  EXPECT_TRUE(std::is_sorted(times_s.begin() + 1, times_s.end()));
}

TEST(SettingsMeasurement, LooksOnceWhereAllStandsStill) { EXPECT_EQ(budget_times(test::small_dome(), 4).size(), 1U); }

TEST(SettingsMeasurement, FindsALensWithinAnError) {
  const Show show = falling_show();
  ShowRenderer renderer(show, Backend::cpu);
  const Budget budget{0.2, std::nullopt};
  const SettingsMeasurement measured = measure_settings(renderer, show, order_for(budget, LensChoice::live));
  const BudgetChoice choice = choose_setting(measured.settings, budget, BudgetFirst::error);
  EXPECT_TRUE(choice.holds_error);
  EXPECT_GT(measured.settings[choice.setting].frame_ms(), 0.0);
  EXPECT_FALSE(measured.cut_short);
}

TEST(SettingsMeasurement, KnowsWhatTheOnePictureTookThatThereWasTimeFor) {
  const Show show = test::small_dome();
  ShowRenderer renderer(show, Backend::cpu);
  MeasurementOrder order = order_for({std::nullopt, 25.0}, LensChoice::direct);
  order.size_px = 1280;
  order.limit_s = 2.0;
  // A simulated clock that advances by a tenth of a second with every reading.
  double now_s = 0.0;
  order.now = [&now_s] { return now_s += 0.1; };
  const SettingsMeasurement measured = measure_settings(renderer, show, order);
  EXPECT_EQ(measured.untimed, UntimedFrames::for_time);
  EXPECT_NEAR(measured.quickest_ms, 100.0, 1e-6);
  EXPECT_EQ(measured.quickest_px, 160);
  EXPECT_TRUE(std::isnan(measured.settings.front().frame_ms()));
}

//! Returns the message about a setting whose frame time is unknown, at 25 frames per second.
std::string text_without_time(UntimedFrames untimed, double quickest_ms) {
  const Budget budget{std::nullopt, 25.0};
  SettingsMeasurement measured;
  measured.settings.emplace_back();
  measured.width_px = 1280;
  measured.untimed = untimed;
  measured.quickest_ms = quickest_ms;
  measured.quickest_px = 160;
  return choice_text(budget, measured, choose_setting(measured.settings, budget, BudgetFirst::error));
}

TEST(SettingsMeasurement, SaysThatAFrameTakesMoreThanAPictureDid) {
  EXPECT_THAT(text_without_time(UntimedFrames::for_time, 581.0),
              testing::HasSubstr(
                  "more than 581 ms per frame (measured with a picture 160 px wide; there was no time for a "
                  "larger one); the frame rate is missed: it allows 40.0 ms per frame, so the fastest lens is used"));
}

TEST(SettingsMeasurement, SaysWhyNothingIsKnownOfPolygons) {
  EXPECT_THAT(
      text_without_time(UntimedFrames::polygons, std::numeric_limits<double>::quiet_NaN()),
      testing::HasSubstr("because polygons take seconds to start without a GPU; the frame rate is unknown, so the "
                         "fastest lens is used"));
}

TEST(SettingsMeasurement, LeavesTheRenderersQualityAsItWas) {
  const Show show = falling_show();
  ShowRenderer renderer(show, Backend::cpu, LensChoice::live);
  const FrameQuality before = renderer.quality();
  measure_settings(renderer, show, order_for({1.0, 30.0}, LensChoice::live));
  EXPECT_EQ(renderer.quality(), before);
}

TEST(SettingsMeasurement, MeasuresFinerLensesForARateAndAPlainLook) {
  const Show show = falling_show();
  ShowRenderer renderer(show, Backend::cpu);
  const SettingsMeasurement measured =
      measure_settings(renderer, show, order_for({std::nullopt, 30.0}, LensChoice::live));
  std::vector<double> errors_px;
  for (const MeasuredSetting& setting : measured.settings) {
    if (setting.quality.filter == SkyFilter::ewa) {
      errors_px.push_back(setting.error_px);
    }
  }
  ASSERT_GT(errors_px.size(), 4U);
  EXPECT_LT(errors_px.back(), 0.1 * errors_px.front());
  EXPECT_EQ(measured.settings.back().quality.filter, SkyFilter::point);
}

TEST(SettingsMeasurement, NeedsNoNewLensWhereTheCameraStaysAtItsPlace) {
  const Show show = test::small_dome();
  ShowRenderer renderer(show, Backend::cpu);
  const SettingsMeasurement measured =
      measure_settings(renderer, show, order_for({0.5, std::nullopt}, LensChoice::live));
  EXPECT_EQ(measured.settings.front().lens_ms, 0.0);
}

TEST(SettingsMeasurement, EndsInTimeByAnyClock) {
  const Show show = falling_show();
  // Clocks that advance with every reading, by the given number of seconds, simulate machines that
  // are more or less slow.
  for (const double look_s : {0.001, 0.01, 0.05, 0.2}) {
    ShowRenderer renderer(show, Backend::cpu);
    MeasurementOrder order = order_for({0.2, 30.0}, LensChoice::automatic);
    order.limit_s = 2.0;
    double now_s = 0.0;
    order.now = [&] { return now_s += look_s; };
    const SettingsMeasurement measured = measure_settings(renderer, show, order);
    // After the time limit, the clock is read at most three times: at the end of a lens that was
    // expected to take as long as the first one, whose time is not measured; to notice that the time
    // is over; and for the duration of the measurement.
    EXPECT_LE(measured.took_s, 2.0 + 3.01 * look_s) << look_s;
    EXPECT_FALSE(measured.settings.empty()) << look_s;
  }
}

//! The parameter is the name of a built-in show.
class BudgetOfShow : public testing::TestWithParam<const char*> {};

TEST_P(BudgetOfShow, HoldsAtRandomMoments) {
  Show show = read_show(built_in_content_folder() / "shows" / (std::string(GetParam()) + ".toml"));
  show.sky.map = test::small_dome().sky.map;
  show.sky.stars.clear();
  const Budget budget{0.25, std::nullopt};
  ShowRenderer renderer(show, Backend::cpu);
  const MeasurementOrder order = order_for(budget, LensChoice::automatic);
  const SettingsMeasurement measured = measure_settings(renderer, show, order);
  const BudgetChoice choice = choose_setting(measured.settings, budget, BudgetFirst::error);
  const BudgetCheck check = check_error(renderer, show, measured.settings[choice.setting].quality, order.size_px,
                                        test::sanitized ? 4 : 20, 7, 48);
  EXPECT_TRUE(choice.holds_error);
  EXPECT_LE(check.worst_px, 0.25) << "at " << check.worst_time_s << " s";
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, BudgetOfShow, testing::Values("once-around", "fall", "first-light"),
                         [](const auto& show) {
                           std::string name = show.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(SettingsMeasurement, SaysWhereNoLensIsWithinAnError) {
  // The camera of this show sees pixels near the edge of the shadow, which contain many repeated
  // images of the sky; float cannot resolve them.
  Show show = read_show(built_in_content_folder() / "shows" / "prograde-edge.toml");
  show.sky.map = test::small_dome().sky.map;
  ShowRenderer renderer(show, Backend::cpu);
  const Budget budget{0.01, std::nullopt};
  const SettingsMeasurement measured = measure_settings(renderer, show, order_for(budget, LensChoice::live));
  const BudgetChoice choice = choose_setting(measured.settings, budget, BudgetFirst::error);
  EXPECT_FALSE(choice.holds_error);
  EXPECT_GT(measured.settings[choice.setting].error_px, 0.005);
}

TEST(BudgetCheck, FindsALensThatIsTooCoarse) {
  const Show show = falling_show();
  ShowRenderer renderer(show, Backend::cpu);
  const BudgetCheck coarse = check_error(renderer, show, {8.0, LensChoice::live, SkyFilter::ewa}, 256, 5, 7);
  EXPECT_GT(coarse.worst_px, 0.5);
}

}  // namespace
}  // namespace ergodome
