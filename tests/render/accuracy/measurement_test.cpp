#include "render/accuracy/measurement.h"

#include <gmock/gmock.h>

namespace ergodome {
namespace {

Measurement choice(const std::string& method, double p99, std::vector<double> frame_ms,
                   std::vector<double> prepare_ms = {}) {
  Measurement measured;
  measured.method = method;
  measured.error = {100, 0.1 * p99, p99, 2.0 * p99, 3.0 * p99};
  measured.frame_ms = std::move(frame_ms);
  measured.prepare_ms = std::move(prepare_ms);
  return measured;
}

//! Returns the measurements of two methods: a grid, which is slow to build and fast to read, and
//! rays.
AccuracyAxis two_methods() {
  AccuracyAxis axis;
  axis.base = "rays";
  axis.choices = {choice("rays", 0.5, {4.0, 4.0}), choice("rays", 0.05, {6.0, 12.0}),
                  choice("grid", 0.08, {3.0, 6.0}, {30.0, 30.0}), choice("grid", 0.01, {5.0, 5.0}, {90.0, 90.0}),
                  choice("rough", 2.0, {1.0, 1.0})};
  return axis;
}

TEST(EqualError, TakesTheCheapestThatHoldsTheError) {
  const AccuracyAxis axis = two_methods();
  EXPECT_EQ(cheapest_within(axis, 0.1, FrameCost::ready), &axis.choices[2]);
  EXPECT_EQ(cheapest_within(axis, 0.1, FrameCost::anew), &axis.choices[1]);
  EXPECT_EQ(cheapest_within(axis, 0.1, FrameCost::ready, "rays"), &axis.choices[1]);
  EXPECT_EQ(cheapest_within(axis, 0.001, FrameCost::ready), nullptr);
}

TEST(EqualError, ComparesMethodsRoundByRound) {
  const AccuracyAxis axis = two_methods();
  const std::vector<EqualErrorRow> rows = compare_at(axis, 0.1, FrameCost::ready);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].method, "grid");
  EXPECT_EQ(rows[1].ratio.minimum, 0.5);
  EXPECT_EQ(rows[1].ratio.maximum, 0.5);
  EXPECT_EQ(rows[2].choice, nullptr);
  EXPECT_EQ(rows[2].ratio.runs, 0);
}

TEST(EqualError, MarksTheParetoFrontOfBothCosts) {
  AccuracyAxis axis = two_methods();
  mark_pareto(axis);
  const auto marks = [&](bool Measurement::*mark) {
    std::string text;
    for (const Measurement& each : axis.choices) {
      text += each.*mark ? '*' : '.';
    }
    return text;
  };
  EXPECT_EQ(marks(&Measurement::best_ready), "*.***");
  EXPECT_EQ(marks(&Measurement::best_anew), "**.**");
}

TEST(EqualError, AnAxisIsFoundByItsName) {
  AccuracyReport report;
  report.axes.push_back(two_methods());
  report.axes.back().name = "lens";
  EXPECT_EQ(find_axis(report, "lens"), report.axes.data());
  EXPECT_EQ(find_axis(report, "stars"), nullptr);
}

}  // namespace
}  // namespace ergodome
