#pragma once

#include <array>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/lens/grid_build.h"
#include "render/lens/grid/hanging_nodes.h"

namespace ergodome {

//! What a build of a grid did.
struct GridStatistics {
  int nodes = 0;
  int leaves = 0;
  int flagged_leaves = 0;
  long traced_nodes = 0;
  long traced_checks = 0;
  double flagged_px = 0.0;  //!< area of the flagged leaves on the screen [px²]
};

//! A cell on its way: its place in units of the finest cells, its slot in the tree, its corners' nodes.
struct OpenCell {
  CellBox box;
  int slot;
  std::array<int, 4> corners;
};

//! Places of nodes in a chart.
struct ChartPlaces {
  std::vector<float> gamma_turns;
  std::vector<float> s;
};

//! The tree of a grid's cells while it grows, level by level: which nodes its cells have, which of them are leaves and which are split.
//! What is a good cell, and what a node holds, is its user's.
class GrowingGrid {
 public:
  //! Grows in `station`, whose tree and leaves are empty; where it is mirrored, half of the columns are built.
  GrowingGrid(LensStation& station, int columns, int rows) : station_(station), columns_(columns), rows_(rows) {}

  //! The cells of the first level.
  std::vector<OpenCell> root_cells();

  //! Finds or makes the nodes of new cells. Returns the places of those that are new, which are numbered from `first` on.
  ChartPlaces place_corners(std::vector<OpenCell>& open, int first);

  //! The cells as they are checked.
  [[nodiscard]] std::vector<GridCell> checked_cells(const std::vector<OpenCell>& open) const;

  //! Makes a leaf of a cell; a flagged one is left to rays.
  void make_leaf(const OpenCell& cell, float error_px, bool flagged, float area_px);

  //! Halves a cell along γ (axis 0) or s (1); the halves are added to the next level.
  void split(const OpenCell& cell, int axis, std::vector<OpenCell>& next);

  //! The places of the first `count` nodes.
  [[nodiscard]] ChartPlaces node_places(std::size_t count) const;

  [[nodiscard]] const NodeByPlace& nodes() const { return node_by_place_; }
  //! The leaves' places, in order.
  [[nodiscard]] const std::vector<CellBox>& leaf_boxes() const { return boxes_; }
  [[nodiscard]] GridStatistics& statistics() { return statistics_; }

 private:
  [[nodiscard]] float gamma_turns(int place) const {
    return static_cast<float>(place) / static_cast<float>(columns_ * finest_a_root);
  }
  [[nodiscard]] float s_of(int place) const {
    return static_cast<float>(place) / static_cast<float>(rows_ * finest_a_root);
  }

  LensStation& station_;
  int columns_;  //!< of the whole sky
  int rows_;
  NodeByPlace node_by_place_;
  std::vector<CellBox> boxes_;
  GridStatistics statistics_;
};

}  // namespace ergodome
