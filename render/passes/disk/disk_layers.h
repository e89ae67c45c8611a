#pragma once

#include <memory>
#include <optional>

#include "content/trajectory/disk_station.h"
#include "render/backend/buffer.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/place_turn.h"
#include "render/passes/disk/joined_disk.h"

namespace ergodome {

//! A disk's layers at a place between two stations, at one, or beside one, in host memory; see StationBlend, which does the same for lenses. Layers
//! are numbers and no directions: nothing is turned.
class DiskLayers {
 public:
  //! At a station, or beside one with derivatives.
  DiskLayers(std::shared_ptr<const DiskStation> station, const LensPlace& place);

  //! Between two; with derivatives, also beside their line.
  DiskLayers(std::shared_ptr<const JoinedDisk> stations, const LensPlace& place);

  //! The grid as kernels read it; it points into this object.
  [[nodiscard]] DiskGrid view() const;

 private:
  void set_edge(const LensPlace& place);
  void keep(int set, const std::vector<float>& nodes);

  std::shared_ptr<const DiskStation> cells_;  //!< whose cells they are, with its nodes where these are not moved
  std::optional<EdgeTable> edge_;             //!< where it is not that station's
  Buffer<float> nodes_[layer_orders];         //!< where they are another place's
};

}  // namespace ergodome
