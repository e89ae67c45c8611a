#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "content/trajectory/lens_station.h"

namespace ergodome {

//! Finest cells along a side of a root cell: places in a grid are whole numbers of them.
inline constexpr int finest_a_root = 1 << 12;

//! A cell's place and extent in finest cells.
struct CellBox {
  int gamma;
  int s;
  int width;
  int height;
};

//! A node's place in finest cells; one that closes the circle is the one that opens it.
struct NodePlace {
  int gamma;
  int s;

  [[nodiscard]] std::uint64_t key() const {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(gamma)) << 32U | static_cast<std::uint32_t>(s);
  }
};

using NodeByPlace = std::unordered_map<std::uint64_t, int>;

//! The place (γ, s) of a grid as a node: γ runs round unless the grid is mirrored.
NodePlace node_place(const LensStation& station, int gamma, int s);

//! The place of a cell's corner: (γ0, s0), (γ1, s0), (γ0, s1), (γ1, s1).
NodePlace corner_place(const LensStation& station, const CellBox& box, int corner);

//! Gives nodes in the middle of a larger leaf's side the values that the side has there, so that neighbours of different size agree
//! in value and in all first derivatives, and the nodes' changes along r and θ likewise. `boxes`: the leaves' places.
void mend_hanging_nodes(LensStation& station, const NodeByPlace& nodes, const std::vector<CellBox>& boxes);

}  // namespace ergodome
