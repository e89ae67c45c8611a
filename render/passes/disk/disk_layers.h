#pragma once

#include <memory>
#include <optional>

#include "content/trajectory/disk_station.h"
#include "render/backend/buffer.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/place_turn.h"
#include "render/passes/disk/joined_disk.h"

namespace ergodome {

//! Layers of a disk at a position at, beside or between stations, in host memory; compare
//! StationBlend for lenses. Layers are scalars, so nothing needs to be rotated.
class DiskLayers {
 public:
  //! Uses a single station; if it has derivatives, also for positions beside it.
  DiskLayers(std::shared_ptr<const DiskStation> station, const LensPlace& place);

  //! Blends two stations; if they have derivatives, also for positions beside the line between
  //! them.
  DiskLayers(std::shared_ptr<const JoinedDisk> stations, const LensPlace& place);

  //! Returns the grid for kernels; it points into this object.
  [[nodiscard]] DiskGrid view() const;

 private:
  void set_edge(const LensPlace& place);
  void keep(int set, const std::vector<float>& nodes);

  std::shared_ptr<const DiskStation> cells_;  //!< station with the cells, and the nodes unless moved
  std::optional<EdgeTable> edge_;             //!< set unless the edge is that station's
  Buffer<float> nodes_[layer_orders];         //!< set unless the nodes are that station's
};

}  // namespace ergodome
