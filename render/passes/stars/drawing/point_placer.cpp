#include "render/passes/stars/drawing/point_placer.h"

#include <algorithm>
#include <vector>

#include "kernels/launch/launch.h"

namespace ergodome {

PlacedPoints PointPlacer::place(const PlacedImages& images, const EyeCamera& eye, const Projection& projection,
                                const SplatSettings& settings) {
  if (images.count == 0) {
    return {};
  }
  const std::vector<StarRegion> regions = star_regions(projection, settings);
  const int count = static_cast<int>(regions.size()) * images.count;
  reserve(backend_, static_cast<std::size_t>(count), "star points", points_);
  clear(backend_, spiked_, 1);
  StarPointBatch batch{};
  std::copy(&eye.frame_from_view[0][0], &eye.frame_from_view[0][0] + 9, &batch.frame_from_view[0][0]);
  batch.images = images.images.data();
  batch.spiked = spiked_.data();
  batch.count = images.count;
  for (const StarRegion& region : regions) {
    batch.region = region;
    batch.points = points_.data() + static_cast<std::ptrdiff_t>(region.number) * images.count;
    launch(backend_, batch);
  }
  std::int32_t spiked = 0;
  spiked_.read(&spiked, 1);
  return {points_.data(), count, spiked};
}

}  // namespace ergodome
