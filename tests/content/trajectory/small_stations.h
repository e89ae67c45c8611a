#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "content/trajectory/disk_station.h"

// Small lens grids and disk grids ("stations") with random numbers, for tests of trajectory files.
namespace ergodome::test {

//! Returns a lens grid with two root cells, one of which is split. Its numbers have very different
//! magnitudes.
inline LensStation small_station(double r, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  LensStation s;
  s.spacetime = Spacetime{0.9};
  s.r = r;
  s.theta = 1.25;
  s.centre = {-1.0F, 0.0F, 0.0F};
  s.first = {0.0F, 1.0F, 0.0F};
  s.second = {0.0F, 0.0F, 1.0F};
  s.edge.assign(64, 0.3F);
  s.range = 9.5F;
  s.columns = 2;
  s.rows = 1;
  s.tree = {2 * 2 + 1, -1 - (2 * 0 + 1), -1 - 2 * 1, -1 - 2 * 2};
  s.leaves = {0, 1, 2, 3, 1, 4, 3, 5, 0, 1, 4, 5};
  s.leaf_error_px = {0.5F, 0.01F, 1e30F};
  s.nodes.resize(6 * floats_a_node);
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const bool pad = i % 16 == 7 || i % 16 == 11 || i % 16 == 15;
    s.nodes[i] = i % 16 == 3 ? 1.0F : (pad ? 0.0F : normal(random) * std::pow(10.0F, normal(random)));
  }
  return s;
}

inline void expect_same(const LensStation& a, const LensStation& b) {
  EXPECT_EQ(a.spacetime, b.spacetime);
  EXPECT_EQ(a.r, b.r);
  EXPECT_EQ(a.theta, b.theta);
  EXPECT_EQ(a.edge, b.edge);
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.mirrored, b.mirrored);
  EXPECT_EQ(a.tree, b.tree);
  EXPECT_EQ(a.leaves, b.leaves);
  EXPECT_EQ(a.leaf_error_px, b.leaf_error_px);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.nodes_along_r, b.nodes_along_r);
  EXPECT_EQ(a.nodes_along_theta, b.nodes_along_theta);
}

//! Returns a disk grid with the cells of small_station(); with a pattern, it has three sets of
//! nodes.
inline DiskStation small_disk(double r, bool pattern = false, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  DiskStation disk;
  disk.cells = small_station(r);
  disk.cells.nodes.clear();
  disk.inner_r = 2.5;
  disk.outer_r = 20.0;
  disk.pattern = pattern;
  disk.orders = {7, 0, 1};
  for (int set = 0; set < disk.sets(); ++set) {
    disk.nodes[set].resize(6 * floats_a_node);
    for (std::size_t i = 0; i < disk.nodes[set].size(); ++i) {
      disk.nodes[set][i] = i % 4 == 3 && !pattern ? 0.0F : normal(random) * std::pow(10.0F, normal(random));
    }
  }
  return disk;
}

inline void expect_same(const DiskStation& a, const DiskStation& b) {
  expect_same(a.cells, b.cells);
  EXPECT_EQ(a.inner_r, b.inner_r);
  EXPECT_EQ(a.outer_r, b.outer_r);
  EXPECT_EQ(a.pattern, b.pattern);
  EXPECT_EQ(a.orders, b.orders);
  for (int set = 0; set < layer_orders; ++set) {
    EXPECT_EQ(a.nodes[set], b.nodes[set]);
    EXPECT_EQ(a.nodes_along_r[set], b.nodes_along_r[set]);
    EXPECT_EQ(a.nodes_along_theta[set], b.nodes_along_theta[set]);
  }
}

}  // namespace ergodome::test
