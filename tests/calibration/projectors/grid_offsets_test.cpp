#include "calibration/projectors/grid_offsets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

//! A grid with 2 x 2 points; offsets are listed row by row.
const GridOffsets nudged = {2, {0.02, -0.1, 0.05, 0.25}, {-0.03, 0.04, -0.25, 0.2}};

//! Returns a grid with all points moved to their limits, each in a different direction.
GridOffsets crumpled(int points) {
  GridOffsets grid = GridOffsets().resized(points);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t point = 0; point < grid.right.size(); ++point) {
      const double angle = 2.4 * static_cast<double>(point);
      grid.move(point, std::cos(angle), std::sin(angle));
    }
  }
  return grid;
}

void expect_positions_restored(const GridOffsets& grid) {
  for (int i = 0; i < 23 * 23; ++i) {
    const int row = i / 23;
    const RasterPosition position = {(i % 23) / 22.0, row / 22.0};
    const RasterPosition back = moved_back(grid, moved_position(grid, position));
    EXPECT_NEAR(back.x, position.x, 1e-9) << grid.points << ": " << i;
    EXPECT_NEAR(back.y, position.y, 1e-9) << grid.points << ": " << i;
  }
}

TEST(GridOffsets, PointsGoWhereTheyAreSent) {
  const RasterPosition corners[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    const RasterPosition position = moved_position(nudged, corners[i]);
    EXPECT_DOUBLE_EQ(position.x, corners[i].x + nudged.right[i]);
    EXPECT_DOUBLE_EQ(position.y, corners[i].y + nudged.down[i]);
  }
  GridOffsets grid = GridOffsets().resized(5);
  grid.move(2 * 5 + 3, 0.03, -0.02);
  EXPECT_DOUBLE_EQ(moved_position(grid, {0.75, 0.5}).x, 0.78);
  EXPECT_DOUBLE_EQ(moved_position(grid, {0.75, 0.5}).y, 0.48);
  // Halfway to the next point of the grid, the shift is half as large; at the next point it is
  // zero.
  EXPECT_DOUBLE_EQ(moved_position(grid, {0.625, 0.5}).x, 0.64);
  EXPECT_DOUBLE_EQ(moved_position(grid, {0.5, 0.5}).x, 0.5);
}

TEST(GridOffsets, TheMiddleOfCornersGoesByTheirMean) {
  const RasterPosition middle = moved_position(nudged, {0.5, 0.5});
  EXPECT_NEAR(middle.x, 0.5 + (0.02 - 0.1 + 0.25 + 0.05) / 4, 1e-15);
  EXPECT_NEAR(middle.y, 0.5 + (-0.03 + 0.04 + 0.2 - 0.25) / 4, 1e-15);
}

TEST(GridOffsets, FinerGridsKeepTheDisplacement) {
  const GridOffsets fine = nudged.resized(9);
  for (const RasterPosition& position :
       {RasterPosition{0.1, 0.9}, RasterPosition{0.5, 0.33}, RasterPosition{1.0, 0.0}}) {
    EXPECT_NEAR(moved_position(fine, position).x, moved_position(nudged, position).x, 1e-12);
    EXPECT_NEAR(moved_position(fine, position).y, moved_position(nudged, position).y, 1e-12);
  }
  const GridOffsets corners = fine.resized(2);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(corners.right[i], nudged.right[i], 1e-15);
  }
}

TEST(GridOffsets, EveryPlaceComesBack) {
  GridOffsets farthest;
  farthest.right = {0.25, -0.25, 0.25, -0.25};
  farthest.down = {-0.25, 0.25, 0.25, -0.25};
  expect_positions_restored(nudged);
  expect_positions_restored(farthest);
  for (const int points : GridOffsets::sizes) {
    expect_positions_restored(crumpled(points));
  }
}

TEST(GridOffsets, NeighborsNeverPassOneAnother) {
  for (const int points : GridOffsets::sizes) {
    const GridOffsets grid = crumpled(points);
    EXPECT_FALSE(grid.none());
    for (int row = 0; row < points; ++row) {
      for (int column = 0; column + 1 < points; ++column) {
        const std::size_t at = grid.index(column, row);
        EXPECT_GE(grid.right[at + 1] - grid.right[at] + 1.0 / (points - 1),
                  (1.0 - GridOffsets::slack) / (points - 1) - 1e-12);
      }
    }
  }
}

TEST(GridOffsets, MeshesGetTheNodesThatAGridNeedsAndShowTheSame) {
  WarpMesh mesh;
  mesh.columns = 2;
  mesh.rows = 3;
  for (int i = 0; i < 6; ++i) {
    const int row = i / 2;
    mesh.nodes.push_back({static_cast<float>(i % 2), 0.5F * static_cast<float>(row), 0.1F * static_cast<float>(i),
                          0.05F * static_cast<float>(i * i), 1.0F, i != 5});
  }
  EXPECT_EQ(refined_for(GridOffsets(), mesh).nodes.size(), 6U);
  const WarpMesh fine = refined_for(GridOffsets().resized(5), mesh);
  ASSERT_GE(fine.columns, 9);
  ASSERT_GE(fine.rows, 9);
  const int across = fine.columns - 1;
  const int down = (fine.rows - 1) / 2;
  EXPECT_EQ(fine.at(across, down).u, mesh.at(1, 1).u);
  EXPECT_EQ(fine.at(0, 2 * down).v, mesh.at(0, 2).v);
  // The middle of the diagonal of the mesh's first cell.
  EXPECT_NEAR(fine.at(across / 2, down / 2).v, 0.5F * (mesh.at(0, 0).v + mesh.at(1, 1).v), 1e-6F);
  EXPECT_TRUE(fine.at(across, down).valid);
  EXPECT_FALSE(fine.at(across, 2 * down).valid);
  EXPECT_FALSE(fine.at(across - 1, 2 * down - 1).valid);
}

TEST(GridOffsets, MasksGoAlong) {
  BlendMap mask = {100, 50, 1, 8, std::vector<float>(5000)};
  for (int i = 0; i < 5000; ++i) {
    mask.values[static_cast<std::size_t>(i)] = i % 100 < 50 ? 0.0F : 1.0F;
  }
  GridOffsets aside;
  aside.right = {0.1, 0.1, 0.1, 0.1};
  const BlendMap moved = moved_mask(aside, mask);
  EXPECT_EQ(moved.values[25 * 100 + 55], 0.0F);
  EXPECT_EQ(moved.values[25 * 100 + 65], 1.0F);
  EXPECT_EQ(moved_mask({}, mask).values, mask.values);
}

}  // namespace
}  // namespace ergodome
