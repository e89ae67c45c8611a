#include "app/budget/play_budget.h"

#include <gmock/gmock.h>

namespace ergodome {
namespace {

using testing::HasSubstr;

PlayPlan plan_with(const Budget& budget) {
  PlayPlan plan;
  plan.budget = budget;
  plan.whole_px = 1024;
  for (const int size_px : {1024, 840, 689}) {
    plan.ladder.push_back({{0.1, LensChoice::automatic, SkyFilter::ewa}, size_px, 0.09, 6, 30e-6 * size_px * size_px});
  }
  plan.first = 1;
  return plan;
}

TEST(PlayBudget, BeginsOnTheRungOfThePlan) {
  EXPECT_EQ(PlayBudget(plan_with({0.25, 30.0})).rung().size_px, 840);
  EXPECT_EQ(PlayBudget(plan_with({0.25, std::nullopt})).rung().size_px, 840);
}

TEST(PlayBudget, GoesDownWhereMovingPicturesAreTooSlow) {
  PlayBudget budget(plan_with({0.25, 30.0}));
  for (int i = 0; i < 40; ++i) {
    budget.note_picture(60.0, 60.0);
  }
  EXPECT_EQ(budget.rung().size_px, 689);
}

TEST(PlayBudget, GivesWhatStandsStillAllTheTimeThatItTakes) {
  PlayBudget budget(plan_with({0.25, 30.0}));
  for (int i = 0; i < 40; ++i) {
    budget.note_picture(500.0, std::nullopt);
  }
  EXPECT_EQ(budget.rung().size_px, 840);
  EXPECT_THAT(budget.summary_text(), HasSubstr("nothing moved"));
}

TEST(PlayBudget, TellsTheErrorOfTheStartUntilEnoughWasMeasured) {
  PlayBudget budget(plan_with({0.25, std::nullopt}));
  budget.note_errors(std::vector<double>(99, 0.5));
  EXPECT_EQ(budget.error_px(), 0.09);
  budget.note_errors(std::vector<double>(99, 0.5));
  EXPECT_EQ(budget.error_px(), 0.5);
}

TEST(PlayBudget, ForgetsErrorsOfLongAgo) {
  PlayBudget budget(plan_with({0.25, std::nullopt}));
  budget.note_errors(std::vector<double>(500, 9.0));
  budget.note_errors(std::vector<double>(1000, 0.1));
  EXPECT_EQ(budget.error_px(), 0.1);
}

TEST(PlayBudget, MakesTheLensFinerWherePicturesAreBeyondTheError) {
  PlayBudget budget(plan_with({0.25, std::nullopt}));
  budget.note_errors(std::vector<double>(499, 0.3));
  EXPECT_EQ(budget.rung().quality.budget_px, 0.1);
  budget.note_errors({0.3});
  EXPECT_NEAR(budget.rung().quality.budget_px, 0.07, 1e-12);
  // Errors of 0.2 px are within the budget of 0.25 px, so the lens stays as it is. Errors of 0.05
  // px are so far within it that the lens becomes coarser again.
  budget.note_errors(std::vector<double>(500, 0.2));
  EXPECT_NEAR(budget.rung().quality.budget_px, 0.07, 1e-12);
  budget.note_errors(std::vector<double>(1000, 0.05));
  EXPECT_NEAR(budget.rung().quality.budget_px, 0.1, 1e-12);
}

TEST(PlayBudget, MakesNoLensFinerThanATenthOfTheLaddersOrCoarserThanIt) {
  PlayBudget budget(plan_with({0.25, std::nullopt}));
  for (int i = 0; i < 30; ++i) {
    budget.note_errors(std::vector<double>(500, 9.0));
  }
  EXPECT_GT(budget.rung().quality.budget_px, 0.005);
  for (int i = 0; i < 60; ++i) {
    budget.note_errors(std::vector<double>(500, 0.0));
  }
  EXPECT_EQ(budget.rung().quality.budget_px, 0.1);
}

TEST(PlayBudget, LeavesTheLensOfARateAlone) {
  PlayBudget budget(plan_with({std::nullopt, 30.0}));
  budget.note_errors(std::vector<double>(1000, 9.0));
  EXPECT_EQ(budget.rung().quality.budget_px, 0.1);
}

TEST(PlayBudget, MeasuresNowAndThen) {
  PlayBudget budget(plan_with({0.25, std::nullopt}));
  EXPECT_TRUE(budget.wants_errors(100.0));
  budget.ask_errors(100.0);
  EXPECT_FALSE(budget.wants_errors(100.5));
  EXPECT_TRUE(budget.wants_errors(101.5));
}

TEST(PlayBudget, WaitsForALensNoLongerThanARateLeavesTimeFor) {
  EXPECT_EQ(lens_patience_ms({0.25, std::nullopt}), 20.0);
  EXPECT_EQ(lens_patience_ms({0.25, 100.0}), 4.0);
  EXPECT_EQ(lens_patience_ms({0.25, 5.0}), 20.0);
}

TEST(PlayBudget, DisplaysErrorTimeRateAndStep) {
  PlayBudget budget(plan_with({0.25, 30.0}));
  budget.note_picture(25.0, 33.0);
  EXPECT_EQ(budget.display_text(),
            "budget 0.25px,30fps: measured error 0.090 px, 25.0 of 33.3 ms, 30.3 fps, step 2 of 3");
}

TEST(PlayBudget, SumsUpHowTheRateWasHeld) {
  PlayBudget budget(plan_with({std::nullopt, 50.0}));
  for (int i = 0; i < 3; ++i) {
    budget.note_picture(10.0, 20.0);
  }
  budget.note_picture(10.0, 40.0);
  EXPECT_THAT(
      budget.summary_text(),
      HasSubstr("budget 50fps: 40.00 fps over 4 frames (-20.0 % from the target), 25.0 % of "
                "them late, the longest 40 ms; settings changed 0 times, ending at step 2 of 3 (1: most accurate)"));
}

}  // namespace
}  // namespace ergodome
