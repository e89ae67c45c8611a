#include "render/published/connection_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kernels/core/angles.h"
#include "tests/support/errors.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

ConnectionTableSettings table_for(double r_observer) {
  ConnectionTableSettings settings;
  settings.r_observer_nearest = r_observer;
  settings.r_observer_farthest = r_observer;
  return settings;
}

//! Errors of a table against the closed form.
struct TableErrors {
  std::vector<double> xi_deg, time, emission_deg, distance;

  static double median(std::vector<double> errors) {
    std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2), errors.end());
    return errors[errors.size() / 2];
  }
  static double largest(const std::vector<double>& errors) { return *std::max_element(errors.begin(), errors.end()); }
};

//! Returns the errors of a table for random pairs of points, uniform in 1/r and φ.
TableErrors errors_of(const ConnectionTable& table, int count) {
  const ConnectionGrid& grid = table.view().grid;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(grid.u_low, grid.u_high);
  std::uniform_real_distribution<double> u_observer(grid.u_observer_low, grid.u_observer_high);
  std::uniform_real_distribution<double> phi(0.0, pi * grid.orders);
  TableErrors errors;
  for (int i = 0; i < count; ++i) {
    const double r = 1.0 / u(random);
    const double r_observer = 1.0 / (grid.layers > 1 ? u_observer(random) : grid.u_observer_low);
    const double angle = phi(random);
    const ConnectingRay exact = connecting_ray(r_observer, r, angle);
    const SeenPoint read = look_up_connection(table.view(), r_observer, r, angle);
    errors.xi_deg.push_back(std::abs(read.xi - exact.xi) * 180.0 / pi);
    errors.time.push_back(std::abs(read.travel_time - exact.travel_time));
    errors.distance.push_back(std::abs(read.affine_distance - exact.affine_distance));
    errors.emission_deg.push_back(std::abs(read.emission_angle - exact.emission_angle) * 180.0 / pi);
  }
  return errors;
}

constexpr int pairs = test::sanitized ? 500 : 5'000;

TEST(ConnectionTable, AgreesWithTheClosedFormForThePublishedObservers) {
  for (const double r_observer : {20.0, 40.0, 60.0}) {
    const ConnectionTable table(table_for(r_observer));
    const TableErrors errors = errors_of(table, pairs);
    EXPECT_LT(TableErrors::median(errors.xi_deg), 1e-6) << r_observer;
    EXPECT_LT(TableErrors::largest(errors.xi_deg), 1e-4) << r_observer;
    EXPECT_LT(TableErrors::median(errors.time), 1e-5) << r_observer;
    EXPECT_LT(TableErrors::largest(errors.time), 1e-4) << r_observer;
    EXPECT_LT(TableErrors::largest(errors.distance), 2e-4) << r_observer;
    EXPECT_LT(TableErrors::largest(errors.emission_deg), 1e-4) << r_observer;
  }
}

TEST(ConnectionTable, IsSmoothWhereDirectionsAreNot) {
  // Points straight behind the hole, at both ends of the azimuth axis, and close to the observer.
  const ConnectionTable table(table_for(20.0));
  for (const auto& [r, angle, allowed] : {std::array{8.0, pi, 1e-7},
                                          {8.0, 2.0 * pi, 1e-7},
                                          {8.0, 0.0, 1e-7},
                                          {8.0, 1e-4, 1e-7},
                                          {20.5, 0.0, 1e-7},
                                          {20.01, 1e-3, 2e-5},
                                          {20.0, 1e-2, 1e-5},
                                          {2.5, 6.0, 1e-7},
                                          {30.0, 6.0, 1e-7}}) {
    const ConnectingRay exact = connecting_ray(20.0, r, angle);
    const SeenPoint read = look_up_connection(table.view(), 20.0, r, angle);
    EXPECT_NEAR(read.xi, exact.xi, allowed) << r << " " << angle;
    EXPECT_NEAR(read.travel_time, exact.travel_time, 1e-5) << r << " " << angle;
    EXPECT_NEAR(read.emission_angle, exact.emission_angle, allowed) << r << " " << angle;
  }
}

TEST(ConnectionTable, ServesObserversNearThePhotonSphereAndInsideIt) {
  for (const double r_observer : {2.6, 3.0, 4.0}) {
    const TableErrors errors = errors_of(ConnectionTable(table_for(r_observer)), pairs / 5);
    EXPECT_LT(TableErrors::median(errors.xi_deg), 1e-5) << r_observer;
    EXPECT_LT(TableErrors::median(errors.time), 1e-4) << r_observer;
  }
}

TEST(ConnectionTable, ServesARangeOfObservers) {
  ConnectionTableSettings settings;
  settings.r_observer_nearest = 10.0;
  settings.r_observer_farthest = 60.0;
  settings.layers = 24;
  settings.rows = 128;
  settings.columns = 128;
  const TableErrors errors = errors_of(ConnectionTable(settings), pairs);
  EXPECT_LT(TableErrors::median(errors.xi_deg), 1e-4);
  EXPECT_LT(TableErrors::median(errors.time), 1e-3);
}

TEST(ConnectionTable, ReachesFromTheHorizonToFarAway) {
  ConnectionTableSettings settings = table_for(40.0);
  settings.r_nearest = 2.05;
  settings.r_farthest = 300.0;
  const TableErrors errors = errors_of(ConnectionTable(settings), pairs / 5);
  EXPECT_LT(TableErrors::median(errors.xi_deg), 1e-5);
}

TEST(ConnectionTable, HoldsAsManyOrdersAsAreAskedFor) {
  ConnectionTableSettings settings = table_for(40.0);
  settings.orders = 5;
  const ConnectionTable table(settings);
  const TableErrors errors = errors_of(table, pairs / 5);
  EXPECT_LT(TableErrors::median(errors.xi_deg), 1e-6);
  EXPECT_LT(TableErrors::largest(errors.xi_deg), 1e-4);
  EXPECT_TRUE(covers(table.view().grid, 40.0, 8.0, 5.0 * pi));
  EXPECT_FALSE(covers(table.view().grid, 40.0, 8.0, 5.1 * pi));
}

TEST(ConnectionTable, KnowsWhatItHolds) {
  const ConnectionTable table(table_for(40.0));
  const ConnectionGrid& grid = table.view().grid;
  EXPECT_TRUE(covers(grid, 40.0, 2.5, 0.0));
  EXPECT_TRUE(covers(grid, 40.0, 30.0, 2.0 * pi));
  EXPECT_FALSE(covers(grid, 40.0, 2.4, 1.0));
  EXPECT_FALSE(covers(grid, 40.0, 31.0, 1.0));
  EXPECT_FALSE(covers(grid, 40.0, 8.0, 6.3));
  EXPECT_FALSE(covers(grid, 41.0, 8.0, 1.0));
}

TEST(ConnectionTable, RefusesSettingsThatMakeNoTable) {
  const auto problem_of = [](void (*change)(ConnectionTableSettings&)) {
    ConnectionTableSettings settings;
    change(settings);
    return test::error_of([&] { const ConnectionTable table(settings); });
  };
  EXPECT_THAT(problem_of([](auto& s) { s.r_nearest = 2.0; }), HasSubstr("radii"));
  EXPECT_THAT(problem_of([](auto& s) { s.orders = 1; }), HasSubstr("orders"));
  EXPECT_THAT(problem_of([](auto& s) { s.orders = 17; }), HasSubstr("orders"));
  EXPECT_THAT(problem_of([](auto& s) { s.r_nearest = s.r_farthest; }), HasSubstr("radii"));
  EXPECT_THAT(problem_of([](auto& s) { s.r_observer_nearest = std::nan(""); }), HasSubstr("radii"));
  EXPECT_THAT(problem_of([](auto& s) { s.r_observer_nearest = 20.0; }), HasSubstr("layers"));
  EXPECT_THAT(problem_of([](auto& s) { s.rows = 3; }), HasSubstr("size"));
  EXPECT_THAT(problem_of([](auto& s) { s.columns = 1'000'000; }), HasSubstr("size"));
}

}  // namespace
}  // namespace ergodome
