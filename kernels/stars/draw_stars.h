#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/projection/cube_cells.h"
#include "kernels/projection/projection.h"
#include "kernels/stars/star_point.h"

// Batches that draw points of light: points are assigned to tiles, whose pixels then add their
// light.
namespace ergodome {

//! Side of the square tiles by which pixels find the points that shine on them [px].
inline constexpr int star_tile_px = 16;

//! Steps, run in this order: count each tile's points, list them at the offsets in `first`, and
//! sort each tile's list by point number.
enum class StarTileStep { count, list, sort };

//! Finds the points of light that may shine on each tile. Arrays lie in the backend's memory.
struct StarTileBatch {
  const StarPoint* points;
  int point_count;
  //! Number of threads that share a point's tiles (points with spikes cover many).
  int point_threads;
  bool spikes_alone;  //!< skips points without spikes
  double reach_px;    //!< how far a point's light reaches along x and y
  int width_px;       //!< width of the picture
  int height_px;
  bool wraps;   //!< the picture's left and right edges meet
  int columns;  //!< tiles per row
  int tile_count;
  std::int32_t* counts;  //!< points per tile; must be zero before the steps `count` and `list`
  //! Index in `members` of each tile's first point; has tile_count + 1 elements.
  std::int32_t* first;
  std::int32_t* members;
  StarTileStep step = StarTileStep::count;
};

//! Adds the light of points to rows of a picture. Each pixel is computed on its own, so the result
//! does not depend on the number of threads. Arrays lie in the backend's memory.
struct StarLightBatch {
  float* rgba;                     //!< the rows of the picture, four floats per pixel
  ProjectionOf<float> projection;  //!< projection of the whole picture
  int first_row;
  int row_count;
  PixelCell cells[cube_faces];  //!< the part of the picture that each star region covers
  const StarPoint* points;
  int point_count;
  //! Index in `members` of each tile's first point, as in StarTileBatch.
  const std::int32_t* first;
  //! Indices in `points`, sorted within each tile; a repeated index counts once.
  const std::int32_t* members;
  int tile_columns;
  //! 1 / (√2 σ) of the Gaussian over which a point's light is spread [1/px]; 0: all light falls on
  //! the pixel that contains the point.
  float narrower;
  float reach_px;  //!< radius at which the Gaussian is cut off
  float share;     //!< 0.5 / (fraction of the Gaussian within reach_px)
  //! Spike pattern, three floats per pixel. If it is nullptr, points are drawn; otherwise only
  //! their spikes.
  const float* pattern;
  int pattern_px;
};

template <>
struct Kernel<StarTileBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr bool compiled_once = true;
  static constexpr bool counted = false;
  static const char* name(const StarTileBatch& /*batch*/) { return "place_stars"; }
  static int elements(const StarTileBatch& batch) {
    return batch.step == StarTileStep::sort ? batch.tile_count : batch.point_threads * batch.point_count;
  }
};

template <>
struct Kernel<StarLightBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr bool compiled_once = true;
  static const char* name(const StarLightBatch& batch) {
    return batch.pattern != nullptr ? "draw_spikes" : "splat_stars";
  }
  static PixelRows rows(const StarLightBatch& batch) { return {batch.projection.width_px, batch.row_count}; }
  static long work(const StarLightBatch& batch) { return batch.point_count; }

  template <class Visit>
  static void visit_outputs(const StarLightBatch& batch, const Visit& visit) {
    visit("rgba", batch.rgba, 4L * element_count(batch));
  }
};

}  // namespace ergodome
