#pragma once

#include <memory>
#include <optional>

#include "render/lens/lens_chooser.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_layers.h"

namespace ergodome {

//! Provides disk layers for pictures that are streamed from baked stations.
class StreamedDisk {
 public:
  explicit StreamedDisk(std::shared_ptr<StationStream> stream) : stream_(std::move(stream)) {}

  //! Returns the layers at a picture's position and show time, valid until the next call. Returns
  //! nothing if the stations that provided the lens (LensChooser::choose) have no layers for this
  //! disk, if blending them exceeds the bake's budget, or off the show's path.
  std::optional<DiskGrid> layers_for(const DiskGridRequest& request, LensChoice choice, std::optional<double> time_s);

 private:
  void blend(const StationPair& pair, const LensPlace& place);

  std::shared_ptr<StationStream> stream_;
  std::shared_ptr<const DiskStation> first_;  //!< stations of `joined_`
  std::shared_ptr<const DiskStation> second_;
  std::shared_ptr<const JoinedDisk> joined_;  //!< null if they cannot be joined
  std::optional<DiskLayers> layers_;
};

}  // namespace ergodome
