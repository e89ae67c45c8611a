#include "render/lens/quadtree_source.h"

#include <utility>

#include "render/lens/direct_lens.h"

namespace ergodome {

QuadtreeSource::QuadtreeSource(std::shared_ptr<const QuadtreeLens> grid, const EyeCamera& eye,
                               const Projection& projection, double tolerance_px)
    : grid_(std::move(grid)),
      prototype_{pixel_batch(eye, projection, tolerance_px), look_up_of(grid_->view(), QuadtreeInterpolation::spline)} {
}

void QuadtreeSource::fill(int first_row, int row_count, const LensPixels& out) const {
  QuadtreePixelBatch batch = prototype_;
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  batch.pixels.out = out;
  launch(batch);
}

}  // namespace ergodome
