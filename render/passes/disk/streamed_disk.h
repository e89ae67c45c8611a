#pragma once

#include <memory>
#include <optional>

#include "render/lens/lens_chooser.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_layers.h"

namespace ergodome {

//! The disk of pictures that are streamed from baked stations.
class StreamedDisk {
 public:
  explicit StreamedDisk(std::shared_ptr<StationStream> stream) : stream_(std::move(stream)) {}

  //! The layers of a picture's place at a show time, kept here until the next are asked for. Nothing where the stations that the lens came from
  //! (LensChooser::choose) have none, or none for this disk, where blending them misses more than the bake's budget, and off the show's path.
  std::optional<DiskGrid> layers_for(const DiskGridRequest& request, LensChoice choice, std::optional<double> time_s);

 private:
  void blend(const StationPair& pair, const LensPlace& place);

  std::shared_ptr<StationStream> stream_;
  std::shared_ptr<const DiskStation> first_;  //!< whose layers are joined
  std::shared_ptr<const DiskStation> second_;
  std::shared_ptr<const JoinedDisk> joined_;  //!< nullptr where they cannot be
  std::optional<DiskLayers> layers_;
};

}  // namespace ergodome
