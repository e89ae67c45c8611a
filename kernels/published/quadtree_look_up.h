#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/published/quadtree_grid.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Rays and pixels that are read from quadtree grids.
namespace ergodome {

//! The shadow in a quadtree grid, in its rows and columns: a center, and the distance of the edge
//! from it.
struct QuadtreeShadow {
  float row;
  float column;
  //! Distance of the edge at the angle 2π i / count, from the direction of increasing columns
  //! towards that of increasing rows.
  const float* radius;
  int count;
};

//! A quadtree grid, or two of the same level to blend (VE, section 4.3.3).
struct QuadtreeLookUp {
  QuadtreeGrid grids[2];
  QuadtreeShadow shadows[2];
  float second_weight;  //!< weight of the second grid; 0: only the first is used
  QuadtreeInterpolation interpolation;
};

//! Rays of one camera, read from quadtree grids in the frame of its observer. Outputs of
//! integration, such as `steps`, receive 0.
struct QuadtreeRaysBatch {
  RayBatch<double> rays;
  QuadtreeLookUp look_up;
};

//! A block of rows of one image, read from quadtree grids in the frame of its observer.
struct QuadtreePixelBatch {
  PixelBatch pixels;  //!< pixels to read; the batch's edge is not used
  QuadtreeLookUp look_up;
};

inline namespace ERGO_TARGET {

namespace detail {
ERGO_HD float shadow_radius(const QuadtreeShadow& shadow, float angle) {
  const float position = (angle < 0.0F ? angle + 6.28318531F : angle) * static_cast<float>(shadow.count) * 0.159154943F;
  const int whole = static_cast<int>(position);
  const float t = position - static_cast<float>(whole);
  return (1.0F - t) * shadow.radius[whole % shadow.count] + t * shadow.radius[(whole + 1) % shadow.count];
}

//! Reads one grid of the pair after the warp that moves its shadow to that of the blend. The warp
//! fades out at 1.5 times the radius of the shadow.
ERGO_HD SkyAngles read_warped(const QuadtreeLookUp& look_up, int which, const QuadtreeShadow& middle, float radius,
                              float distance, float angle) {
  const QuadtreeShadow& own = look_up.shadows[which];
  const QuadtreeGrid& grid = look_up.grids[which];
  const float w = minimum((distance - radius) / (0.5F * radius), 1.0F);
  const float warped = w < 1.0F ? w * 1.5F * radius + (1.0F - w) * shadow_radius(own, angle) : distance;
  float row = w * middle.row + (1.0F - w) * own.row + warped * ::sinf(angle);
  float column = w * middle.column + (1.0F - w) * own.column + warped * ::cosf(angle);
  const float rows = static_cast<float>(1 << grid.level);
  // Beyond a pole the sky continues half a turn around.
  const bool beyond = row < 0.0F || row > rows;
  row = row < 0.0F ? -row : (row > rows ? 2.0F * rows - row : row);
  column += beyond ? rows : 0.0F;
  column -= 2.0F * rows * ::floorf(column / (2.0F * rows));
  return read_quadtree(grid, look_up.interpolation, row, column);
}
}  // namespace detail

//! Returns the sky at a position in finest cells, from one grid or from the blend of two.
ERGO_HD SkyAngles read_quadtree(const QuadtreeLookUp& look_up, float row, float column) {
  const float t = look_up.second_weight;
  if (!(t > 0.0F)) {
    return read_quadtree(look_up.grids[0], look_up.interpolation, row, column);
  }
  const QuadtreeShadow& a = look_up.shadows[0];
  const QuadtreeShadow& b = look_up.shadows[1];
  const QuadtreeShadow middle = {a.row + t * (b.row - a.row), a.column + t * (b.column - a.column), nullptr, 0};
  const float columns = static_cast<float>(2 << look_up.grids[0].level);
  float across = column - middle.column;
  across -= columns * ::floorf(across / columns + 0.5F);
  const float down = row - middle.row;
  const float distance = ::sqrtf(across * across + down * down);
  const float angle = ::atan2f(down, across);
  const float radius = (1.0F - t) * detail::shadow_radius(a, angle) + t * detail::shadow_radius(b, angle);
  if (distance < radius) {
    return shadow_angles();
  }
  return detail::mixed(detail::read_warped(look_up, 0, middle, radius, distance, angle),
                       detail::read_warped(look_up, 1, middle, radius, distance, angle), t);
}

}  // namespace ERGO_TARGET
template <>
struct Kernel<QuadtreeRaysBatch> : KernelDefaults {
  using Real = double;
  static constexpr bool wide = false;
  static constexpr int grain = 512;
  static const char* name(const QuadtreeRaysBatch& /*batch*/) { return "read_quadtree_rays"; }
  static int elements(const QuadtreeRaysBatch& batch) { return batch.rays.count; }

  template <class Visit>
  static void visit_outputs(const QuadtreeRaysBatch& batch, const Visit& visit) {
    Kernel<RayBatch<double>>::visit_outputs(batch.rays, visit);
  }
};

template <>
struct Kernel<QuadtreePixelBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr int grain = 512;
  static const char* name(const QuadtreePixelBatch& /*batch*/) { return "read_quadtree_pixels"; }
  static PixelRows rows(const QuadtreePixelBatch& batch) { return Kernel<PixelBatch>::rows(batch.pixels); }

  template <class Visit>
  static void visit_outputs(const QuadtreePixelBatch& batch, const Visit& visit) {
    Kernel<PixelBatch>::visit_outputs(batch.pixels, visit);
  }
};

}  // namespace ergodome
