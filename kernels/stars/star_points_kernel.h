#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/shared_counter.h"
#include "kernels/stars/star_region.h"

// The kernels that convert images of stars to points of light on a picture.
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
    } else {
      light_up(region, pixel_solid_angle(region.projection, x, y), point);
      if (spiked) {
        count_up(batch.spiked);
      }
    }
    batch.points[index] = point;
  }
};

template <class T, class Action>
void dispatch(const StarPointBatch& batch, const Action& action) {
  action(PlaceImage{batch});
}

//! Converts the illuminance of points to picture values. Index i covers points i * lanes to (i + 1) * lanes - 1.
template <class T>
struct LightPoints {
  static constexpr int lanes = RealTraits<T>::lane_count;

  const PointLightBatch& batch;

  ERGO_HD void operator()(int index) const {
    const StarRegion& region = batch.region;
    StarPoint* const points = batch.points + index * lanes;
    const int count = batch.count - index * lanes < lanes ? batch.count - index * lanes : lanes;
    double x[lanes];
    double y[lanes];
    for (int i = 0; i < lanes; ++i) {
      const StarPoint& point = points[i < count ? i : 0];
      x[i] = point.x_px - region.cell.left_px;
      y[i] = point.y_px - region.cell.top_px;
    }
    const T solid_angle = pixel_solid_angle(region.projection, load_lanes<T>(x, 0, lanes), load_lanes<T>(y, 0, lanes));
    for (int i = 0; i < count; ++i) {
      light_up(region, lane(solid_angle, i), points[i]);
    }
  }
};

template <class T, class Action>
void dispatch(const PointLightBatch& batch, const Action& action) {
  action(LightPoints<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
