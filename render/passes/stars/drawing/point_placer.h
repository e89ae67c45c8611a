#pragma once

#include <cstdint>

#include "kernels/stars/star_point.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/stars/drawing/star_splat.h"
#include "render/passes/stars/search/image_joiner.h"

namespace ergodome {

//! Points of light in a backend's memory. Entries for images outside the picture are marked as
//! unused.
struct PlacedPoints {
  const StarPoint* points = nullptr;
  int count = 0;
  int spiked = 0;  //!< number of points with spikes
};

//! Projects star images to points in the backend's memory: the equivalent of star_points() for
//! GPUs. Reuses its memory.
class PointPlacer {
 public:
  explicit PointPlacer(Backend backend) : backend_(backend), spiked_(backend, 1, "star points") {}

  //! Returns the points of a picture; valid until the next call.
  PlacedPoints place(const PlacedImages& images, const EyeCamera& eye, const Projection& projection,
                     const SplatSettings& settings);

 private:
  Backend backend_;
  Buffer<StarPoint> points_;
  Buffer<std::int32_t> spiked_;
};

}  // namespace ergodome
