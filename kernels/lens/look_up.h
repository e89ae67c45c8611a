#pragma once

#include "kernels/lens/lens_grid.h"
#include "kernels/lens/quadtree_grid.h"
#include "kernels/metric/frame_boost.h"
#include "kernels/trace/trace_pixels.h"
#include "kernels/trace/trace_rays.h"

namespace ergodome {

//! A block of rows of one image, read from a lens grid. The grid serves any motion of the observer: `aberration` leads to its rain
//! frame. Pixels of leaves that could not be made good are traced.
struct LookUpBatch {
  PixelBatch pixels;  //!< its edge is not used: the grid's chart has the edge
  LensGrid grid;
  AberrationOf<float> aberration;
};

//! Rays of one camera, read from a lens grid; `rays.method` and the channels `steps`, `error_estimate` and `mino_time` speak of the
//! rays that are traced (steps 0: read from the grid).
template <class S>
struct LookUpRaysBatch {
  RayBatch<S> rays;
  LensGrid grid;
  AberrationOf<S> aberration;
};

//! Rays of one camera, read from a quadtree grid in the frame of its observer; `steps` and the like receive 0.
struct QuadtreeRaysBatch {
  RayBatch<double> rays;
  QuadtreeGrid grid;
  QuadtreeInterpolation interpolation;
};

}  // namespace ergodome
