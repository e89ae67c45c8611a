#include "calibration/formats/warps/triangle_warp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/warps/warp_conversion.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::HasSubstr;

//! Returns the nodes of a grid, row by row from the top; u is x + y / 10.
std::vector<WarpNode> grid_nodes(int columns, int rows) {
  std::vector<WarpNode> nodes;
  for (int i = 0; i < columns * rows; ++i) {
    const float x = static_cast<float>(i % columns) / static_cast<float>(columns - 1);
    const int row = i / columns;
    const float y = static_cast<float>(row) / static_cast<float>(rows - 1);
    nodes.push_back({x, y, x + 0.1F * y, y});
  }
  return nodes;
}

std::vector<WarpTriangle> grid_triangles(std::uint32_t columns, std::uint32_t rows, bool other_diagonal) {
  std::vector<WarpTriangle> triangles;
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column;
      const std::uint32_t d = a + columns;
      if (other_diagonal) {
        triangles.insert(triangles.end(), {{a, a + 1, d}, {a + 1, d + 1, d}});
      } else {
        triangles.insert(triangles.end(), {{a, a + 1, d + 1}, {a, d + 1, d}});
      }
    }
  }
  return triangles;
}

void expect_grid(const WarpMesh& mesh, int columns, int rows) {
  ASSERT_EQ(mesh.topology, MeshTopology::rectangular);
  ASSERT_EQ(mesh.columns, columns);
  ASSERT_EQ(mesh.rows, rows);
  const std::vector<WarpNode> wanted = grid_nodes(columns, rows);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(mesh.nodes[i].x, wanted[i].x) << i;
    EXPECT_EQ(mesh.nodes[i].y, wanted[i].y) << i;
    EXPECT_EQ(mesh.nodes[i].u, wanted[i].u) << i;
  }
}

TEST(TriangleWarp, TrianglesOfAGridBecomeThatGrid) {
  for (const auto& [columns, rows] : {std::pair(4, 3), std::pair(2, 2), std::pair(2, 5), std::pair(7, 2)}) {
    for (const bool other : {false, true}) {
      const auto triangles =
          grid_triangles(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), other);
      expect_grid(warp_from_triangles(grid_nodes(columns, rows), triangles, "a"), columns, rows);
    }
  }
}

TEST(TriangleWarp, GridsOfAnyOrderComeOutInReadingOrder) {
  const auto triangles = grid_triangles(4, 3, false);
  std::vector<WarpNode> bottom_up = grid_nodes(4, 3);
  std::reverse(bottom_up.begin(), bottom_up.end());
  expect_grid(warp_from_triangles(bottom_up, triangles, "a"), 4, 3);
  // The file lists the grid column by column: what looks like a row is a column of the grid.
  std::vector<WarpNode> columns_first;
  const std::vector<WarpNode> nodes = grid_nodes(4, 3);
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      columns_first.push_back(nodes[row * 4 + column]);
    }
  }
  expect_grid(warp_from_triangles(columns_first, grid_triangles(3, 4, true), "a"), 4, 3);
}

TEST(TriangleWarp, AGridWithAHoleKeepsTheHole) {
  auto triangles = grid_triangles(4, 4, false);
  // Removes triangles 8 and 9, which form the middle cell.
  triangles.erase(triangles.begin() + 8, triangles.begin() + 10);
  const WarpMesh mesh = warp_from_triangles(grid_nodes(4, 4), triangles, "a");
  EXPECT_EQ(mesh.topology, MeshTopology::separate_cells);
  const WarpMesh drawn = resampled_warp(mesh, 30, 30);
  EXPECT_FALSE(drawn.at(15, 15).valid);
  ASSERT_TRUE(drawn.at(5, 15).valid);
  EXPECT_NEAR(drawn.at(5, 15).u, 5.5 / 30.0 + 0.1 * 15.5 / 30.0, 1e-5);
  EXPECT_TRUE(drawn.at(25, 25).valid);
}

TEST(TriangleWarp, AFanOfTrianglesIsDrawnAsItIs) {
  // A square of four triangles around its center. u is 0 at the corners and 1 at the center.
  const std::vector<WarpNode> nodes = {{0, 0, 0, 0}, {1, 0, 0, 0}, {1, 1, 0, 0}, {0, 1, 0, 0}, {0.5, 0.5, 1, 0}};
  const WarpMesh mesh = warp_from_triangles(nodes, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, "a");
  EXPECT_EQ(mesh.columns, 11);
  EXPECT_EQ(mesh.rows, 2);
  const WarpMesh drawn = resampled_warp(mesh, 20, 20);
  for (const WarpNode& node : drawn.nodes) {
    ASSERT_TRUE(node.valid);
    // As a function of position, u has the shape of a pyramid over the square.
    const double height = 1.0 - 2.0 * std::max(std::abs(node.x - 0.5), std::abs(node.y - 0.5));
    EXPECT_NEAR(node.u, height, 1e-5);
  }
}

TEST(TriangleWarp, AStripJoinsItsRowsByEmptyTriangles) {
  const auto triangles = triangles_of_strip({0, 3, 1, 4, 2, 5, 5, 3, 3, 6, 4, 7, 5, 8});
  expect_grid(warp_from_triangles(grid_nodes(3, 3), triangles, "a"), 3, 3);
}

TEST(TriangleWarp, RefusesNodesThatAreMissing) {
  EXPECT_THAT(error_of([] {
                warp_from_triangles(grid_nodes(2, 2), {{0, 1, 4}}, "a.ol");
              }),
              HasSubstr("a.ol: has a triangle with node 4, but only 4 nodes, counted from 0"));
  EXPECT_THAT(error_of([] { warp_from_triangles(grid_nodes(2, 2), {}, "a.ol"); }), HasSubstr("contains no triangles"));
}

TEST(RefinedWarp, CutsCellsOnTheirTwoTriangles) {
  WarpMesh mesh{MeshTopology::rectangular, 2, 2, grid_nodes(2, 2)};
  mesh.at(1, 0).u = 5.0F;
  const WarpMesh fine = refined_warp(mesh, 4);
  ASSERT_EQ(fine.columns, 5);
  const WarpMesh drawn = resampled_warp(fine, 16, 16);
  const WarpMesh wanted = resampled_warp(mesh, 16, 16);
  for (std::size_t i = 0; i < drawn.nodes.size(); ++i) {
    EXPECT_NEAR(drawn.nodes[i].u, wanted.nodes[i].u, 1e-5) << i;
  }
}

TEST(RefinedWarp, DrawsNoCellThatWasNotDrawn) {
  WarpMesh mesh{MeshTopology::rectangular, 3, 2, grid_nodes(3, 2)};
  mesh.at(2, 1).valid = false;
  const WarpMesh drawn = resampled_warp(refined_warp(mesh, 3), 12, 6);
  for (const WarpNode& node : drawn.nodes) {
    EXPECT_EQ(node.valid, node.x < 0.5F) << node.x << ' ' << node.y;
  }
}

}  // namespace
}  // namespace ergodome
