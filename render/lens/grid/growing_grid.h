#pragma once

#include <array>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/lens/grid_build.h"
#include "render/lens/grid/hanging_nodes.h"

// The cell tree of a lens grid while it is built.

namespace ergodome {

//! Counts the work of building a grid.
struct GridStatistics {
  int nodes = 0;
  int leaves = 0;
  int flagged_leaves = 0;
  long traced_nodes = 0;
  long traced_checks = 0;
  double flagged_px = 0.0;  //!< area of the flagged leaves on the screen [px²]
};

//! A cell that may still be split: its box in units of finest cells, its index in the tree, its
//! corner nodes.
struct OpenCell {
  CellBox box;
  int slot;
  std::array<int, 4> corners;
};

//! Positions of nodes in a chart.
struct ChartPositions {
  std::vector<float> gamma_turns;
  std::vector<float> s;
};

//! The cell tree of a grid while it grows level by level: the nodes of each cell, the leaves, and
//! the split cells. The user of this class decides which cells are split and what values nodes
//! have.
class GrowingGrid {
 public:
  //! Builds the tree in `station`, whose tree and leaves must be empty. If the station is mirrored,
  //! builds half of the columns.
  GrowingGrid(LensStation& station, int columns, int rows) : station_(station), columns_(columns), rows_(rows) {}

  //! Returns the cells of the first level.
  std::vector<OpenCell> root_cells();

  //! Finds or creates the corner nodes of new cells. Returns the chart positions of the created
  //! nodes, which get consecutive numbers from `first`.
  ChartPositions place_corners(std::vector<OpenCell>& open, int first);

  //! Returns the cells in the form that the checks need.
  [[nodiscard]] std::vector<GridCell> checked_cells(const std::vector<OpenCell>& open) const;

  //! Turns a cell into a leaf. The pixels of a flagged leaf are traced.
  void make_leaf(const OpenCell& cell, float error_px, bool flagged, float area_px);

  //! Halves a cell along γ (axis 0) or s (axis 1) and appends the halves to `next`.
  void split(const OpenCell& cell, int axis, std::vector<OpenCell>& next);

  //! Returns the positions of the first `count` nodes.
  [[nodiscard]] ChartPositions node_positions(std::size_t count) const;

  [[nodiscard]] const NodeByPosition& nodes() const { return node_by_position_; }
  //! Returns the boxes of the leaves, in the order of the leaves.
  [[nodiscard]] const std::vector<CellBox>& leaf_boxes() const { return boxes_; }
  [[nodiscard]] GridStatistics& statistics() { return statistics_; }

 private:
  [[nodiscard]] float gamma_turns(int position) const {
    return static_cast<float>(position) / static_cast<float>(columns_ * finest_a_root);
  }
  [[nodiscard]] float s_of(int position) const {
    return static_cast<float>(position) / static_cast<float>(rows_ * finest_a_root);
  }

  LensStation& station_;
  int columns_;  //!< number of columns for the whole sky
  int rows_;
  NodeByPosition node_by_position_;
  std::vector<CellBox> boxes_;
  GridStatistics statistics_;
};

}  // namespace ergodome
