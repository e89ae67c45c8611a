#include "render/accuracy/statistics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace ergodome {
namespace {

using testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Statistics, PercentilesOfAThousandAreTheValuesThatCountThemOff) {
  std::vector<double> values(1000);
  std::iota(values.rbegin(), values.rend(), 1.0);
  const ErrorSummary summary = summary_of(values);
  EXPECT_EQ(summary.count, 1000U);
  EXPECT_EQ(summary.median, 500.0);
  EXPECT_EQ(summary.p99, 990.0);
  EXPECT_EQ(summary.p999, 999.0);
  EXPECT_EQ(summary.largest, 1000.0);
}

TEST(Statistics, OneValueIsAllPercentiles) {
  const ErrorSummary summary = summary_of({0.25});
  EXPECT_EQ(summary.median, 0.25);
  EXPECT_EQ(summary.largest, 0.25);
}

TEST(Statistics, NoValuesHaveNoErrors) {
  const ErrorSummary summary = summary_of({});
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.largest, 0.0);
}

TEST(Statistics, WhatIsNotANumberIsAnInfiniteError) {
  const ErrorSummary summary = summary_of({1.0, std::nan(""), 2.0});
  EXPECT_EQ(summary.median, 2.0);
  EXPECT_EQ(summary.largest, infinity);
}

TEST(Statistics, TheMiddleOfAnEvenNumberOfRunsLiesBetweenTwo) {
  const Spread spread = spread_of({4.0, 1.0, 3.0, 10.0});
  EXPECT_EQ(spread.median, 3.5);
  EXPECT_EQ(spread.minimum, 1.0);
  EXPECT_EQ(spread.maximum, 10.0);
  EXPECT_EQ(spread.runs, 4);
}

TEST(Statistics, RatiosAreOfRunsInTheSameRound) {
  // In the second round, the machine was twice as slow for both methods, which does not change
  // their ratio.
  const Spread ratio = ratio_of({2.0, 4.0, 2.0}, {1.0, 2.0, 1.0, 7.0});
  EXPECT_EQ(ratio.runs, 3);
  EXPECT_EQ(ratio.minimum, 2.0);
  EXPECT_EQ(ratio.maximum, 2.0);
}

TEST(ParetoFront, HoldsWhatNoOtherBeats) {
  const std::vector<double> cost = {1.0, 2.0, 3.0, 4.0, 2.5};
  const std::vector<double> error = {5.0, 3.0, 3.5, 1.0, 3.0};
  EXPECT_THAT(pareto_front(cost, error), ElementsAre(true, true, false, true, false));
}

TEST(ParetoFront, HoldsBothOfTwoThatAreAlike) {
  EXPECT_THAT(pareto_front({1.0, 1.0}, {2.0, 2.0}), ElementsAre(true, true));
}

TEST(ParetoFront, HoldsNothingWithoutBounds) {
  EXPECT_THAT(pareto_front({1.0, infinity, 2.0}, {infinity, 0.0, std::nan("")}), ElementsAre(false, false, false));
}

}  // namespace
}  // namespace ergodome
