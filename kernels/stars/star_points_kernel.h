#pragma once

#include "kernels/core/shared_counter.h"
#include "kernels/stars/star_region.h"

// The kernel that converts images of stars to points of light on a picture.
namespace ergodome::inline ERGO_TARGET {

//! Converts star image i to point of light i.
struct PlaceImage {
  StarPointBatch batch;

  ERGO_HD void operator()(int index) const {
    const StarImage& image = batch.images[index];
    const StarRegion& region = batch.region;
    double x = 0.0;
    double y = 0.0;
    StarPoint point{};
    const bool spiked = image.star >= 0 && has_spikes(region, image.illuminance);
    const bool seen = image.star >= 0 &&
                      project_to_screen(image.direction, batch.frame_from_view, region.projection, x, y) &&
                      point_in_region(region, x, y, image.illuminance, spiked, point);
    if (!seen) {
      constexpr double beside = -1e9;
      point = {beside, beside, {}, {}, region.number};
    } else if (spiked) {
      count_up(batch.spiked);
    }
    batch.points[index] = point;
  }
};

template <class T, class Action>
void dispatch(const StarPointBatch& batch, const Action& action) {
  action(PlaceImage{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
