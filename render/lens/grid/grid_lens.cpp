#include "render/lens/grid/grid_lens.h"

#include <utility>

#include "kernels/lens/tile_shading.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

GridLens::GridLens(Backend backend, const char* name, StationBlend stations, const EyeCamera& eye,
                   const Projection& projection, double tolerance_px, bool behind, GridReading reading)
    : backend_(backend),
      name_(name),
      behind_(behind),
      reading_(backend == Backend::cpu ? reading : GridReading::pixels),
      stations_(std::move(stations)),
      prototype_{
          {pixel_batch(eye, projection, tolerance_px), stations_.view(),
           converted_aberration<float>(aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity))},
          static_cast<float>(tolerance_px)} {
  set_sky_steps(prototype_.look_up.pixels, eye);
}

TileLookUpBatch GridLens::rows(int first_row, int row_count, const LensPixels& out) const {
  TileLookUpBatch batch = prototype_;
  PixelBatch& pixels = batch.look_up.pixels;
  pixels.first_row = first_row;
  pixels.row_count = row_count;
  pixels.out = out;
  return batch;
}

void GridLens::fill(int first_row, int row_count, const LensPixels& out) const {
  const TileLookUpBatch batch = rows(first_row, row_count, out);
  if (reading_ == GridReading::tiles) {
    launch(batch);
  } else {
    launch(backend_, batch.look_up);
  }
}

bool GridLens::shade(int first_row, int row_count, const ShadeBatch& shading) const {
  if (reading_ != GridReading::tiles || !shades_on_tiles(shading.mode, shading.filter, shading.brightening)) {
    return false;
  }
  launch(TileShadeBatch{rows(first_row, row_count, shading.lens), shading});
  return true;
}

}  // namespace ergodome
