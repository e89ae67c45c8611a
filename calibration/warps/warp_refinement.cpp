#include <algorithm>

#include "calibration/warps/warp_conversion.h"

namespace ergodome {

namespace {

//! Returns the node at (s, t) in a cell, each from 0 to 1, to the right and downward. Cells are
//! divided from the top left corner to the bottom right.
WarpNode in_cell(const WarpNode* const corners[4], float s, float t) {
  const WarpNode& a = *corners[0];
  const WarpNode& b = *corners[1];
  const WarpNode& c = *corners[2];
  const WarpNode& d = *corners[3];
  const auto part = [&](float WarpNode::*of) {
    const float side = s >= t ? (s - t) * (b.*of - a.*of) : (t - s) * (d.*of - a.*of);
    return a.*of + side + std::min(s, t) * (c.*of - a.*of);
  };
  // For positions on a cell's side, uses only the two corners of that side.
  const bool left = s < 1.0F;
  const bool right = s > 0.0F;
  const bool top = t < 1.0F;
  const bool bottom = t > 0.0F;
  const bool valid = (a.valid || !(left && top)) && (b.valid || !(right && top)) && (c.valid || !(right && bottom)) &&
                     (d.valid || !(left && bottom));
  return {part(&WarpNode::x), part(&WarpNode::y),         part(&WarpNode::u),
          part(&WarpNode::v), part(&WarpNode::intensity), valid};
}

}  // namespace

WarpMesh refined_warp(const WarpMesh& mesh, int steps) {
  const auto fits = [&](int by) {
    const std::size_t columns = static_cast<std::size_t>(mesh.columns - 1) * static_cast<std::size_t>(by) + 1;
    const std::size_t rows = static_cast<std::size_t>(mesh.rows - 1) * static_cast<std::size_t>(by) + 1;
    constexpr std::size_t max_refined_nodes = std::size_t{1} << 23U;
    return columns <= max_mesh_side && rows <= max_mesh_side && columns * rows <= max_refined_nodes;
  };
  while (steps > 1 && !fits(steps)) {
    --steps;
  }
  if (steps <= 1 || mesh.topology == MeshTopology::polar) {
    return mesh;
  }
  WarpMesh fine{mesh.topology, (mesh.columns - 1) * steps + 1, (mesh.rows - 1) * steps + 1, {}};
  fine.nodes.reserve(static_cast<std::size_t>(fine.columns) * static_cast<std::size_t>(fine.rows));
  for (int row = 0; row < fine.rows; ++row) {
    const int top = std::min(row / steps, mesh.rows - 2);
    for (int column = 0; column < fine.columns; ++column) {
      const int left = std::min(column / steps, mesh.columns - 2);
      const WarpNode* const corners[] = {&mesh.at(left, top), &mesh.at(left + 1, top), &mesh.at(left + 1, top + 1),
                                         &mesh.at(left, top + 1)};
      fine.nodes.push_back(in_cell(corners, static_cast<float>(column - left * steps) / static_cast<float>(steps),
                                   static_cast<float>(row - top * steps) / static_cast<float>(steps)));
    }
  }
  return fine;
}

}  // namespace ergodome
