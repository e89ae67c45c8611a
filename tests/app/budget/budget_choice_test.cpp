#include "app/budget/budget_choice.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

MeasuredSetting measured(double lens_px, double error_px, double frame_ms, SkyFilter filter = SkyFilter::ewa) {
  return {{lens_px, LensChoice::automatic, filter}, error_px, 0.25 * frame_ms, 0.25 * frame_ms, 0.5 * frame_ms};
}

const Budget quarter_pixel_budget{0.25, std::nullopt};
const Budget ten_frames_budget{std::nullopt, 10.0};
const Budget both_halves{0.25, 10.0};

std::size_t chosen_of(const std::vector<MeasuredSetting>& settings, const Budget& budget,
                      BudgetFirst first = BudgetFirst::error) {
  return choose_setting(settings, budget, first).setting;
}

TEST(BudgetChoice, IsTheCheapestWithinAnError) {
  EXPECT_EQ(chosen_of({measured(1.0, 0.5, 10.0), measured(0.5, 0.12, 50.0), measured(0.25, 0.05, 90.0)},
                      quarter_pixel_budget),
            1U);
}

TEST(BudgetChoice, IsTheMostAccurateInTime) {
  EXPECT_EQ(
      chosen_of({measured(1.0, 0.5, 10.0), measured(0.5, 0.12, 99.0), measured(0.25, 0.05, 101.0)}, ten_frames_budget),
      1U);
}

TEST(BudgetChoice, KeepsHalfOfAnErrorForOtherMoments) {
  EXPECT_TRUE(
      choose_setting(std::vector{measured(1.0, 0.125, 10.0)}, quarter_pixel_budget, BudgetFirst::error).holds_error);
  EXPECT_FALSE(
      choose_setting(std::vector{measured(1.0, 0.126, 10.0)}, quarter_pixel_budget, BudgetFirst::error).holds_error);
}

TEST(BudgetChoice, OfTimesAlikeIsTheMoreAccurate) {
  EXPECT_EQ(chosen_of({measured(1.0, 0.12, 50.0), measured(0.5, 0.05, 52.0)}, quarter_pixel_budget), 1U);
}

TEST(BudgetChoice, OfErrorsAlikeIsTheCheaper) {
  EXPECT_EQ(chosen_of({measured(1.0, 0.50, 80.0), measured(0.5, 0.51, 40.0)}, ten_frames_budget), 1U);
}

TEST(BudgetChoice, OfBothIsTheCheapestThatHoldsBoth) {
  const std::vector<MeasuredSetting> settings = {measured(1.0, 0.5, 10.0), measured(0.5, 0.12, 60.0),
                                                 measured(0.25, 0.05, 90.0)};
  for (const BudgetFirst first : {BudgetFirst::error, BudgetFirst::rate}) {
    const BudgetChoice choice = choose_setting(settings, both_halves, first);
    EXPECT_EQ(choice.setting, 1U);
    EXPECT_TRUE(choice.holds_error && choice.holds_rate);
  }
}

TEST(BudgetChoice, WhereBothCannotBeKeepsToWhatComesFirst) {
  const std::vector<MeasuredSetting> settings = {measured(2.0, 1.0, 10.0), measured(1.0, 0.5, 90.0),
                                                 measured(0.5, 0.12, 150.0), measured(0.25, 0.05, 300.0)};
  const BudgetChoice error = choose_setting(settings, both_halves, BudgetFirst::error);
  EXPECT_EQ(error.setting, 2U);
  EXPECT_TRUE(error.holds_error);
  EXPECT_FALSE(error.holds_rate);
  const BudgetChoice rate = choose_setting(settings, both_halves, BudgetFirst::rate);
  EXPECT_EQ(rate.setting, 1U);
  EXPECT_FALSE(rate.holds_error);
  EXPECT_TRUE(rate.holds_rate);
}

TEST(BudgetChoice, WhereNothingFitsIsTheNearest) {
  const std::vector<MeasuredSetting> settings = {measured(1.0, 0.9, 400.0), measured(0.5, 0.4, 500.0)};
  EXPECT_EQ(chosen_of(settings, quarter_pixel_budget), 1U);
  EXPECT_EQ(chosen_of(settings, ten_frames_budget), 0U);
  EXPECT_EQ(chosen_of(settings, both_halves, BudgetFirst::error), 1U);
  EXPECT_EQ(chosen_of(settings, both_halves, BudgetFirst::rate), 0U);
}

TEST(BudgetChoice, LooksPlainlyAtTheMapOnlyForTheRatesSake) {
  const std::vector<MeasuredSetting> settings = {measured(1.0, 0.1, 80.0), measured(1.0, 0.1, 30.0, SkyFilter::point)};
  EXPECT_EQ(chosen_of(settings, quarter_pixel_budget), 0U);
  EXPECT_EQ(chosen_of(settings, both_halves), 0U);
  EXPECT_EQ(chosen_of(settings, {0.25, 25.0}), 1U);
}

TEST(BudgetChoice, WithoutTimesIsTheFirstWithinTheError) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(chosen_of({measured(1.0, 0.5, unknown), measured(0.5, 0.1, unknown), measured(0.25, 0.05, unknown)},
                      quarter_pixel_budget),
            1U);
}

TEST(BudgetChoice, DoesNotTakeWhatWasNotMeasuredForKept) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const BudgetChoice choice =
      choose_setting(std::vector{measured(1.0, unknown, unknown)}, both_halves, BudgetFirst::error);
  EXPECT_FALSE(choice.holds_error);
  EXPECT_FALSE(choice.holds_rate);
}

}  // namespace
}  // namespace ergodome
