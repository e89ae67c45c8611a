#include "render/passes/disk/disk_layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "render/passes/disk/disk_grid_builder.h"
#include "render/passes/disk/disk_grid_error.h"

namespace ergodome {
namespace {

constexpr double spin = 0.9;
constexpr double budget_px = 0.25;

DiskGridSettings settings_at(const LensPosition& position, bool pattern, bool derivatives) {
  DiskGridSettings settings;
  settings.inner_r = innermost_stable_radius(Spacetime{spin}, 1.0);
  settings.outer_r = 15.0;
  settings.pattern = pattern;
  settings.pixel = 2e-3;
  settings.budget_px = 0.5 * budget_px;
  settings.observer = aberration_to_rain(Spacetime{spin}, position.r, position.theta, ObserverMotion::zamo, {});
  settings.derivatives = derivatives;
  return settings;
}

std::shared_ptr<const DiskStation> station_at(const LensPosition& position, bool pattern = false,
                                              bool derivatives = true) {
  return std::make_shared<const DiskStation>(
      build_disk_station(Spacetime{spin}, position.r, position.theta, settings_at(position, pattern, derivatives)));
}

std::shared_ptr<const JoinedDisk> joined(const LensPosition& first, const LensPosition& second, bool pattern = false,
                                         bool derivatives = true) {
  return std::make_shared<const JoinedDisk>(
      join(*station_at(first, pattern, derivatives), *station_at(second, pattern, derivatives)).value());
}

//! Returns the error of a disk grid for a camera at a position [px]. Of the samples that show the
//! disk, 99 % have at most this error.
double error_px(const DiskGrid& grid, const DiskStation& cells, const LensPosition& position) {
  return measure_disk_error(grid, Spacetime{spin}, position, settings_at(position, cells.pattern, true),
                            leaf_samples(cells.cells))
      .p99_px;
}

double error_between(const std::shared_ptr<const JoinedDisk>& stations, const LensPosition& position) {
  const DiskLayers layers(stations, position);
  return error_px(layers.view(), stations->first, position);
}

PatchValue value_at(const DiskGrid& grid, int set, float gamma_turns, float s) {
  const Leaf leaf = find_leaf(grid.cells, gamma_turns, s);
  const LeafPosition at = position_in(leaf, gamma_turns, s);
  return patch_value(grid.nodes[set], grid.cells.leaves + 4 * leaf.number, at.u, at.v, leaf.width_turns, leaf.height);
}

TEST(JoinedDisk, HasThePatchesOfBothStations) {
  const auto first = station_at({20.0, 1.2}, true);
  const auto second = station_at({26.0, 1.0}, true);
  const JoinedDisk both = join(*first, *second).value();
  EXPECT_GE(both.first.cells.leaf_count(), std::max(first->cells.leaf_count(), second->cells.leaf_count()));
  DiskStation second_nodes = both.first;
  for (int set = 0; set < layer_orders; ++set) {
    second_nodes.nodes[set] = both.second.nodes[set];
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  int compared = 0;
  int missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const float gamma_turns = unit(random);
    const float s = unit(random);
    for (const auto& [from, to] :
         {std::pair{first.get(), &both.first}, std::pair{second.get(), &std::as_const(second_nodes)}}) {
      const Leaf leaf = find_leaf(grid_view(from->cells), gamma_turns, s);
      for (int set = 0; set < layer_orders; ++set) {
        if (leaf.flagged || (from->orders[static_cast<std::size_t>(leaf.number)] >> set & 1) == 0) {
          continue;
        }
        const PatchValue wanted = value_at(disk_grid_view(*from), set, gamma_turns, s);
        const PatchValue found = value_at(disk_grid_view(*to), set, gamma_turns, s);
        for (int part = 0; part < 4; ++part) {
          const float miss = std::abs(quad_part(found.sky, part) - quad_part(wanted.sky, part));
          ++compared;
          missed += miss > 1e-3F * (1.0F + std::abs(quad_part(wanted.sky, part))) ? 1 : 0;
        }
      }
    }
  }
  // Where a large leaf and a smaller one share a side, they disagree in the middle of the larger
  // leaf's side, where the smaller one is correct.
  EXPECT_GT(compared, 4000);
  EXPECT_LT(missed, compared / 100);
}

TEST(JoinedDisk, TellsImagesOfEitherStationAndLeavesToRaysWhatEitherLeaves) {
  const auto first = station_at({20.0, 1.2});
  const auto second = station_at({26.0, 1.0});
  const JoinedDisk both = join(*first, *second).value();
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  int differ_by_one = 0;
  for (int i = 0; i < 20'000; ++i) {
    const float gamma_turns = unit(random);
    const float s = unit(random);
    const auto leaf = [&](const DiskStation& of) { return find_leaf(grid_view(of.cells), gamma_turns, s); };
    const auto orders = [&](const DiskStation& of) { return of.orders[static_cast<std::size_t>(leaf(of).number)]; };
    EXPECT_EQ(orders(both.first), orders(*first) | orders(*second));
    EXPECT_EQ(leaf(both.first).flagged, leaf(*first).flagged || leaf(*second).flagged);
    differ_by_one += orders(*first) != orders(*second) ? 1 : 0;
  }
  EXPECT_GT(differ_by_one, 100);
}

TEST(JoinedDisk, IsOnlyOfOneDiskAndOfCamerasOnOneSideOfThePlane) {
  const auto any = station_at({20.0, 1.2});
  EXPECT_TRUE(join(*any, *station_at({26.0, 1.0})).has_value());
  EXPECT_FALSE(join(*any, *station_at({26.0, 1.0}, true)).has_value());
  EXPECT_FALSE(join(*any, *station_at({26.0, 1.0}, false, false)).has_value());
  EXPECT_FALSE(join(*any, *station_at({20.0, 0.5 * pi})).has_value());
}

//! Returns a disk grid with one root cell that was halved again and again along the same axis.
DiskStation strips(int axis, int halvings) {
  DiskStation station;
  station.cells.columns = 1;
  station.cells.rows = 1;
  station.cells.edge.assign(16, 0.3F);
  station.nodes[0].assign(4UL * floats_a_node, 0.0F);
  std::vector<int>& tree = station.cells.tree;
  const int inner = (1 << halvings) - 1;
  for (int i = 0; i < inner; ++i) {
    tree.push_back(2 * (2 * i + 1) + axis);
  }
  for (int leaf = 0; leaf <= inner; ++leaf) {
    tree.push_back(-1 - 2 * leaf);
    station.cells.leaves.insert(station.cells.leaves.end(), {0, 1, 2, 3});
    station.orders.push_back(1);
  }
  return station;
}

TEST(JoinedDisk, OfStationsWithNothingInCommonIsRefusedBeforeItFillsMemory) {
  EXPECT_EQ(join(strips(0, 4), strips(1, 4)).value().first.cells.leaf_count(), 256U);
  EXPECT_FALSE(join(strips(0, 12), strips(1, 12)).has_value());
}

TEST(DiskLayers, AtAStationAreItsOwnNodes) {
  const auto station = station_at({20.0, 1.2});
  const DiskLayers layers(station, {20.0, 1.2});
  EXPECT_EQ(layers.view().nodes[0], station->nodes[0].data());
}

TEST(DiskLayers, BetweenStationsHoldTheBudget) {
  for (const bool pattern : {false, true}) {
    const auto stations = joined({20.0, 1.2}, {23.0, 1.1}, pattern);
    for (const double way : {0.1, 0.25, 0.5, 0.8}) {
      EXPECT_LT(error_between(stations, {20.0 + 3.0 * way, 1.2 - 0.1 * way}), budget_px) << way;
    }
  }
}

TEST(DiskLayers, WithoutDerivativesNeedNearerStations) {
  const LensPosition far = {23.0, 1.1};
  EXPECT_GT(error_between(joined({20.0, 1.2}, {26.0, 1.0}, false, false), far), 2.0 * budget_px);
  const LensPosition near = {20.2, 1.19};
  EXPECT_LT(error_between(joined({20.0, 1.2}, {20.4, 1.18}, false, false), near), budget_px);
}

TEST(DiskLayers, ServeAnEyeBesideAStationAndBesideTheLineBetweenTwo) {
  const LensPosition eye = {20.2, 1.21};
  const auto station = station_at({20.0, 1.2});
  const DiskLayers beside(station, eye);
  EXPECT_LT(error_px(beside.view(), *station, eye), budget_px);
  // Checks the test itself: without the correction by DiskLayers, the grid is too inaccurate for
  // this eye.
  EXPECT_GT(error_px(disk_grid_view(*station), *station, eye), 4.0 * budget_px);
  const auto stations = joined({20.0, 1.2}, {23.0, 1.1});
  EXPECT_LT(error_between(stations, {21.4, 1.16}), budget_px);
}

TEST(DiskLayers, OfCamerasInThePlaneAreBlendedAlongIt) {
  const auto stations = joined({20.0, 0.5 * pi}, {24.0, 0.5 * pi});
  EXPECT_TRUE(stations->first.cells.mirrored);
  EXPECT_LT(error_between(stations, {22.0, 0.5 * pi}), budget_px);
}

TEST(DiskLayers, DoNotReachThroughThePlane) {
  // Light that starts downwards soon crosses the disk's plane if the camera is above it. If the
  // camera is below the plane, this light crosses it only half a turn later. So the crossings of
  // all orders are different on both sides.
  const auto stations = joined({20.0, 0.5 * pi - 0.02}, {20.0, 0.5 * pi + 0.02});
  EXPECT_GT(error_between(stations, {20.0, 0.5 * pi - 0.01}), 10.0 * budget_px);
}

}  // namespace
}  // namespace ergodome
