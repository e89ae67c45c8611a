#include "content/disk_station.h"

namespace ergodome {

DiskGrid disk_grid_view(const DiskStation& station) {
  return {grid_view(station.cells),
          {station.nodes[0].data(), station.nodes[1].data(), station.nodes[2].data()},
          station.orders.data()};
}

}  // namespace ergodome
