#pragma once

#include <memory>
#include <optional>

#include "render/lens/lens_chooser.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_layers.h"

namespace ergodome {

//! Provides disk layers for pictures whose lens is streamed from baked stations.
class StreamedDisk {
 public:
  explicit StreamedDisk(std::shared_ptr<StationStream> stream) : stream_(std::move(stream)) {}

  //! Returns the disk layers at a picture's position and show time, valid until the next call.
  //! Returns nothing if the camera is not on the show's path (no `time_s`), or if the stations that
  //! provided the picture's lens (LensChooser::choose()) have no layers for this disk, or layers
  //! that cannot be joined. Also returns nothing if the error of blending them exceeds the bake's
  //! budget or, for an eye beside the path, allowed_unmeasured_px().
  std::optional<DiskGrid> layers_for(const DiskGridRequest& request, LensChoice choice, std::optional<double> time_s);

 private:
  void blend(const StationPair& pair, const LensPosition& position);

  std::shared_ptr<StationStream> stream_;
  std::shared_ptr<const DiskStation> first_;  //!< the two stations that `joined_` was made from
  std::shared_ptr<const DiskStation> second_;
  //! Null if the layers of the two stations cannot be joined.
  std::shared_ptr<const JoinedDisk> joined_;
  std::optional<DiskLayers> layers_;
};

}  // namespace ergodome
