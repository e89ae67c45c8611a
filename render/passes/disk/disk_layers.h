#pragma once

#include <memory>
#include <optional>

#include "content/trajectory/disk_station.h"
#include "render/backend/buffer.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/lens_position.h"
#include "render/passes/disk/joined_disk.h"

namespace ergodome {

//! Disk layers at the position of a station, beside it, or between two stations, in host memory.
//! StationBlend does the same for lenses. The values of layers are scalars, so nothing needs to be
//! rotated.
class DiskLayers {
 public:
  //! Uses a single station. If it has derivatives along the camera's r and θ, the position may
  //! differ from the station's.
  DiskLayers(std::shared_ptr<const DiskStation> station, const LensPosition& position);

  //! Blends two stations. If they have derivatives along the camera's r and θ, the position need
  //! not be on the line between them in (r, θ).
  DiskLayers(std::shared_ptr<const JoinedDisk> stations, const LensPosition& position);

  //! Returns the grid for kernels; it points into this object.
  [[nodiscard]] DiskGrid view() const;

 private:
  void set_edge(const LensPosition& position);
  void keep(int set, const std::vector<float>& nodes);

  //! Station that provides the cells, and also the nodes if `nodes_` is empty.
  std::shared_ptr<const DiskStation> cells_;
  //! Shadow edge at the position; empty if the edge of `cells_` is used.
  std::optional<EdgeTable> edge_;
  //! Nodes at the position, interpolated or extrapolated; empty if those of `cells_` are used.
  Buffer<float> nodes_[layer_orders];
};

}  // namespace ergodome
