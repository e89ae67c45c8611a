#include <numeric>

#include "kernels/launch/launch.h"
#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/run_on_cpu.h"
#include "kernels/stars/draw_stars_kernel.h"
#include "kernels/stars/search/patch_search_kernel.h"
#include "kernels/stars/search/star_twins_kernel.h"
#include "kernels/stars/star_points_kernel.h"

// Launches of stars for devices. The CPU versions are for tests, and for pictures that are made in
// one piece.
namespace ergodome {

namespace {

template <class Functor>
void run(const Functor& functor, int count) {
  parallel_for(count, grain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      functor(i);
    }
  });
}

}  // namespace

void join_star_images(Backend backend, const StarTwinBatch& batch, StarTwinStep step) {
  if (backend == Backend::cuda) {
    return join_star_images_cuda(batch, step);
  }
  const int found = batch.found_count[0] + batch.found_count[1];
  switch (step) {
    case StarTwinStep::count:
      return run(CountImage<false>{batch}, found);
    case StarTwinStep::number:
      return run(CountImage<true>{batch}, found);
    case StarTwinStep::take:
      break;
  }
  run(TakeImages{batch}, batch.star_count);
}

void place_star_images(Backend backend, const StarPointBatch& batch, int count) {
  static WorkCounter counter("place_star_images");
  const WorkScope work(counter, count);
  if (backend == Backend::cuda) {
    return place_star_images_cuda(batch, count);
  }
  run(PlaceImage{batch}, count);
}

void place_stars(Backend backend, const StarTileBatch& batch, StarTileStep step) {
  if (backend == Backend::cuda) {
    return place_stars_cuda(batch, step);
  }
  switch (step) {
    case StarTileStep::count:
      return run(PlaceStar<false>{batch}, batch.point_threads * batch.point_count);
    case StarTileStep::list:
      return run(PlaceStar<true>{batch}, batch.point_threads * batch.point_count);
    case StarTileStep::sort:
      break;
  }
  run(SortTile{batch}, batch.tile_count);
}

void sum_counts(Backend backend, const std::int32_t* counts, int count, std::int32_t* sums) {
  if (backend == Backend::cuda) {
    return sum_counts_cuda(counts, count, sums);
  }
  sums[0] = 0;
  std::partial_sum(counts, counts + count, sums + 1);
}

void draw_stars(Backend backend, const StarLightBatch& batch, long points) {
  static WorkCounter spots("splat_stars");
  static WorkCounter spikes("draw_spikes");
  WorkCounter& counter = batch.pattern != nullptr ? spikes : spots;
  const WorkScope work(counter, points);
  if (backend == Backend::cuda) {
    draw_stars_cuda(batch);
  } else {
    run(DrawStars{batch}, batch.row_count * batch.projection.width_px);
  }
  finish(counter, backend, batch);
}

void search_patches(Backend backend, const PatchSearchBatch& batch, PatchSearchStep step, int count, int depth) {
  if (backend == Backend::cuda) {
    return search_patches_cuda(batch, step, count, depth);
  }
  with_search_step(batch, step, depth, [&](const auto& functor) { run(functor, count); });
}

}  // namespace ergodome
