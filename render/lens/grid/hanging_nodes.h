#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "content/trajectory/lens_station.h"

// Coordinates of a lens grid, and its hanging nodes: those inside the sides of larger leaves.

namespace ergodome {

//! Number of finest cells along a side of a root cell. Coordinates in a grid are whole numbers of
//! finest cells.
inline constexpr int finest_a_root = 1 << 12;

//! A cell's position and extent in finest cells.
struct CellBox {
  int gamma;
  int s;
  int width;
  int height;
};

//! A node's position in units of finest cells. In γ, the last position of the full circle is
//! identical with the first.
struct NodePosition {
  int gamma;
  int s;

  [[nodiscard]] std::uint64_t key() const {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(gamma)) << 32U | static_cast<std::uint32_t>(s);
  }
};

using NodeByPosition = std::unordered_map<std::uint64_t, int>;

//! Returns the node position at (γ, s) of a grid; γ wraps around unless the grid is mirrored.
NodePosition node_position(const LensStation& station, int gamma, int s);

//! Returns the position of a cell's corner: (γ0, s0), (γ1, s0), (γ0, s1) or (γ1, s1).
NodePosition corner_position(const LensStation& station, const CellBox& box, int corner);

//! Sets nodes inside the side of a larger leaf to the values interpolated along that side, so that
//! leaves of different size agree in value and all first derivatives. Does the same for the nodes'
//! derivatives with respect to the camera's position. `boxes`: the boxes of the leaves.
void mend_hanging_nodes(LensStation& station, const NodeByPosition& nodes, const std::vector<CellBox>& boxes);

}  // namespace ergodome
