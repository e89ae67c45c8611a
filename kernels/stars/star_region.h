#pragma once

#include "kernels/core/vector3.h"
#include "kernels/launch/kernel.h"
#include "kernels/projection/cube_cells.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/projection/projection.h"
#include "kernels/stars/seen_image.h"
#include "kernels/stars/star_point.h"

// Converts images of stars to points of light on a picture.
namespace ergodome {

//! A part of a picture on which images of stars become points
//! (render/passes/stars/drawing/picture_regions.h), and how they shine there.
struct StarRegion {
  Projection projection;
  PixelCell cell;
  int number;
  float scale;             //!< picture value of a luminance of 1 cd/m²
  float spikes_from;       //!< minimum illuminance of images with spikes [lx]
  float spike_strength;    //!< fraction of their light that goes into the spikes
  double reach_px;         //!< how far the light of a point reaches
  double spiked_reach_px;  //!< how far the light of a point with spikes reaches
};

//! Converts images of stars to points on a region, image i to point i. Arrays lie in the backend's
//! memory.
struct StarPointBatch {
  StarRegion region;
  double frame_from_view[3][3];
  const StarImage* images;  //!< entries with a star of -1 are unused
  StarPoint* points;        //!< unused points lie outside all pictures
  std::int32_t* spiked;     //!< number of points with spikes
  int count;                //!< number of images
};

//! Converts the illuminance of a region's points to picture values (light_up()). The points are in host memory.
struct PointLightBatch {
  StarRegion region;
  StarPoint* points;
  int count;
};

inline namespace ERGO_TARGET {

//! Computes the screen position [px] of a direction of the observer. Returns false if it has none.
ERGO_HD bool project_to_screen(const Vector3<float>& n, const double (&frame_from_view)[3][3],
                               const Projection& projection, double& x, double& y) {
  const auto along = [&](int axis) {
    return static_cast<double>(n.x) * frame_from_view[0][axis] + static_cast<double>(n.y) * frame_from_view[1][axis] +
           static_cast<double>(n.z) * frame_from_view[2][axis];
  };
  return pixel_from_direction(projection, {along(0), along(1), along(2)}, x, y);
}

//! Computes the point for light of the given illuminance [lx] at position (x, y) of a region [px]. Its `light` and `spikes`
//! are illuminances until light_up() converts them. Returns false if none of the light may reach the picture.
ERGO_HD bool point_in_region(const StarRegion& region, double x, double y, const Vector3<float>& illuminance,
                             bool has_spikes, StarPoint& point) {
  const Projection& projection = region.projection;
  if (wraps_around(projection)) {
    x -= projection.width_px * ::floor(x / projection.width_px);
  }
  const double reach_px = has_spikes ? region.spiked_reach_px : region.reach_px;
  if (!(x >= -reach_px && x <= projection.width_px + reach_px && y >= -reach_px &&
        y <= projection.height_px + reach_px)) {
    return false;
  }
  const float part = has_spikes ? region.spike_strength : 0.0F;
  point = {x + region.cell.left_px, y + region.cell.top_px, (1.0F - part) * illuminance, part * illuminance,
           region.number};
  return true;
}

//! Converts the illuminance of a point to picture values, given the solid angle of its pixel [sr].
ERGO_HD void light_up(const StarRegion& region, double solid_angle, StarPoint& point) {
  const float value = region.scale / static_cast<float>(maximum(solid_angle, 1e-12));
  point.light = value * point.light;
  point.spikes = value * point.spikes;
}

//! Returns whether an image is bright enough for spikes.
ERGO_HD bool has_spikes(const StarRegion& region, const Vector3<float>& illuminance) {
  return luminance_of(illuminance) >= region.spikes_from;
}

}  // namespace ERGO_TARGET
template <>
struct Kernel<StarPointBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr bool compiled_once = true;
  static const char* name(const StarPointBatch& /*batch*/) { return "place_star_images"; }
  static int elements(const StarPointBatch& batch) { return batch.count; }
};

template <>
struct Kernel<PointLightBatch> : KernelDefaults {
  using Real = double;
  static constexpr bool counted = false;
  static const char* name(const PointLightBatch& /*batch*/) { return "light_points"; }
  static int elements(const PointLightBatch& batch) { return batch.count; }
};

}  // namespace ergodome
