#include "render/lens/grid_lens.h"

#include <utility>

#include "render/lens/direct_lens.h"

namespace ergodome {

GridLens::GridLens(Backend backend, const char* name, StationBlend stations, const EyeCamera& eye,
                   const Projection& projection, double tolerance_px, bool behind)
    : backend_(backend),
      name_(name),
      behind_(behind),
      stations_(std::move(stations)),
      prototype_{
          pixel_batch(eye, projection, tolerance_px), stations_.view(),
          converted_aberration<float>(aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity))} {}

void GridLens::fill(int first_row, int row_count, const LensPixels& out) const {
  LookUpBatch batch = prototype_;
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  batch.pixels.out = out;
  look_up_pixels(backend_, batch);
}

}  // namespace ergodome
