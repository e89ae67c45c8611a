#include "content/trajectory/disk_station.h"

namespace ergodome {

std::size_t DiskStation::bytes() const {
  std::size_t floats = cells.edge.size() + cells.leaf_error_px.size() + nearness.size();
  for (const NodeSets* each : {&nodes, &nodes_along_r, &nodes_along_theta}) {
    for (const std::vector<float>& set : *each) {
      floats += set.size();
    }
  }
  return sizeof(float) * floats + sizeof(int) * (cells.tree.size() + cells.leaves.size()) + orders.size();
}

DiskGrid disk_grid_view(const DiskStation& station) {
  return {grid_view(station.cells),
          {station.nodes[0].data(), station.nodes[1].data(), station.nodes[2].data()},
          station.orders.data(),
          station.nearness.empty() ? nullptr : station.nearness.data()};
}

}  // namespace ergodome
