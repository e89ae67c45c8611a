#include "content/trajectory/lens_station.h"

#include <algorithm>

namespace ergodome {

LensGrid grid_view(const LensStation& station) {
  const auto [smallest, largest] = std::minmax_element(station.edge.begin(), station.edge.end());
  const EdgeCurve edge = {
      station.centre, station.first, station.second, station.edge.data(), static_cast<int>(station.edge.size()),
      *smallest,      *largest};
  return {{edge, station.range}, station.mirrored ? 1 : 0, station.columns,     station.rows,
          station.tree.data(),   station.leaves.data(),    station.nodes.data()};
}

std::vector<LeafBox> leaf_boxes(const LensStation& station) {
  std::vector<LeafBox> leaves(station.leaf_count());
  std::vector<LeafBox> cells(station.tree.size());
  const double width = (station.mirrored ? 0.5 : 1.0) / station.columns;
  const double height = 1.0 / station.rows;
  auto root = cells.begin();
  for (int row = 0; row < station.rows; ++row) {
    for (int column = 0; column < station.columns; ++column) {
      *root++ = {width * column, height * row, width, height};
    }
  }
  // Children are stored after their parents, so one pass in this order reaches all cells.
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int entry = station.tree[i];
    if (entry < 0) {
      leaves[static_cast<std::size_t>((-1 - entry) >> 1)] = cells[i];
      continue;
    }
    LeafBox half = cells[i];
    const bool along_s = (entry & 1) != 0;
    (along_s ? half.height : half.width_turns) *= 0.5;
    cells[static_cast<std::size_t>(entry >> 1)] = half;
    (along_s ? half.s : half.gamma_turns) += along_s ? half.height : half.width_turns;
    cells[static_cast<std::size_t>(entry >> 1) + 1] = half;
  }
  return leaves;
}

std::vector<bool> flagged_leaves(const LensStation& station) {
  std::vector<bool> flagged(station.leaf_count());
  for (const int entry : station.tree) {
    if (entry < 0) {
      flagged[static_cast<std::size_t>((-1 - entry) >> 1)] = ((-1 - entry) & 1) != 0;
    }
  }
  return flagged;
}

}  // namespace ergodome
