#include "render/lens/grid/growing_grid.h"

namespace ergodome {

std::vector<OpenCell> GrowingGrid::root_cells() {
  station_.columns = station_.mirrored ? columns_ / 2 : columns_;
  station_.rows = rows_;
  std::vector<OpenCell> open;
  for (int row = 0; row < station_.rows; ++row) {
    for (int column = 0; column < station_.columns; ++column) {
      const CellBox box = {column * finest_a_root, row * finest_a_root, finest_a_root, finest_a_root};
      open.push_back({box, static_cast<int>(station_.tree.size()), {}});
      station_.tree.push_back(0);
    }
  }
  return open;
}

ChartPositions GrowingGrid::place_corners(std::vector<OpenCell>& open, int first) {
  ChartPositions fresh;
  for (OpenCell& cell : open) {
    for (int corner = 0; corner < 4; ++corner) {
      const NodePosition position = corner_position(station_, cell.box, corner);
      const auto [found, is_new] =
          node_by_position_.try_emplace(position.key(), first + static_cast<int>(fresh.s.size()));
      if (is_new) {
        fresh.gamma_turns.push_back(gamma_turns(position.gamma));
        fresh.s.push_back(s_of(position.s));
      }
      cell.corners[static_cast<std::size_t>(corner)] = found->second;
    }
  }
  statistics_.traced_nodes += static_cast<long>(fresh.s.size());
  return fresh;
}

std::vector<GridCell> GrowingGrid::checked_cells(const std::vector<OpenCell>& open) const {
  std::vector<GridCell> cells;
  cells.reserve(open.size());
  for (const OpenCell& cell : open) {
    const auto& c = cell.corners;
    cells.push_back({{c[0], c[1], c[2], c[3]},
                     gamma_turns(cell.box.gamma),
                     s_of(cell.box.s),
                     gamma_turns(cell.box.width),
                     s_of(cell.box.height)});
  }
  return cells;
}

void GrowingGrid::make_leaf(const OpenCell& cell, float error_px, bool flagged, float area_px) {
  const auto leaf = static_cast<int>(station_.leaf_count());
  station_.leaves.insert(station_.leaves.end(), cell.corners.begin(), cell.corners.end());
  station_.leaf_error_px.push_back(error_px);
  boxes_.push_back(cell.box);
  station_.tree[static_cast<std::size_t>(cell.slot)] = -1 - (2 * leaf + (flagged ? 1 : 0));
  statistics_.leaves += 1;
  statistics_.flagged_leaves += flagged ? 1 : 0;
  statistics_.flagged_px += flagged ? static_cast<double>(area_px) * (station_.mirrored ? 2.0 : 1.0) : 0.0;
}

void GrowingGrid::split(const OpenCell& cell, int axis, std::vector<OpenCell>& next) {
  const auto children = static_cast<int>(station_.tree.size());
  station_.tree[static_cast<std::size_t>(cell.slot)] = 2 * children + axis;
  station_.tree.insert(station_.tree.end(), 2, 0);
  CellBox box = cell.box;
  (axis == 0 ? box.width : box.height) /= 2;
  next.push_back({box, children, {}});
  (axis == 0 ? box.gamma : box.s) += axis == 0 ? box.width : box.height;
  next.push_back({box, children + 1, {}});
}

ChartPositions GrowingGrid::node_positions(std::size_t count) const {
  ChartPositions positions{std::vector<float>(count), std::vector<float>(count)};
  for (const auto& [key, node] : node_by_position_) {
    const auto at = static_cast<std::size_t>(node);
    positions.gamma_turns[at] = gamma_turns(static_cast<int>(key >> 32U));
    positions.s[at] = s_of(static_cast<int>(key & 0xFFFFFFFFU));
  }
  return positions;
}

}  // namespace ergodome
