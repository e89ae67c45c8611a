#include "content/lens_station.h"

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
