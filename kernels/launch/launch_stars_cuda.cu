#include <cub/device/device_scan.cuh>

#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/stars/draw_stars_kernel.h"
#include "kernels/stars/patch_search_kernel.h"

namespace ergodome {

void place_stars_cuda(const StarTileBatch& batch, StarTileStep step) {
  switch (step) {
    case StarTileStep::count:
      return launch_cuda("count_stars", batch.point_count, PlaceStar<false>{batch});
    case StarTileStep::list:
      return launch_cuda("list_stars", batch.point_count, PlaceStar<true>{batch});
    case StarTileStep::sort:
      break;
  }
  launch_cuda("sort_stars", batch.tile_count, SortTile{batch});
}

void sum_counts_cuda(const std::int32_t* counts, int count, std::int32_t* sums) {
  const cudaStream_t stream = current_stream();
  check_cuda(cudaMemsetAsync(sums, 0, sizeof(std::int32_t), stream), "sum_counts");
  std::size_t bytes = 0;
  check_cuda(cub::DeviceScan::InclusiveSum(nullptr, bytes, counts, sums + 1, count, stream), "sum_counts");
  const DeviceScratch<char> room(bytes + 1);
  check_cuda(cub::DeviceScan::InclusiveSum(room.data(), bytes, counts, sums + 1, count, stream), "sum_counts");
  finish_launch("sum_counts");
}

void draw_stars_cuda(const StarLightBatch& batch) {
  launch_cuda("draw_stars", batch.row_count * batch.projection.width_px, DrawStars{batch});
}

void search_patches_cuda(const PatchSearchBatch& batch, PatchSearchStep step, int count, int depth) {
  with_search_step(batch, step, depth, [&](const auto& functor) { launch_cuda("search_patches", count, functor); });
}

}  // namespace ergodome
