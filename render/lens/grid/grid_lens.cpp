#include "render/lens/grid/grid_lens.h"

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
          converted_aberration<float>(aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity))} {
  set_sky_steps(prototype_.pixels, eye);
}

LookUpBatch GridLens::rows(int first_row, int row_count, const LensPixels& out) const {
  LookUpBatch batch = prototype_;
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  batch.pixels.out = out;
  return batch;
}

void GridLens::fill(int first_row, int row_count, const LensPixels& out) const {
  launch(backend_, rows(first_row, row_count, out));
}

bool GridLens::shares_work_with(const LensSource& other) const {
  return backend_ == Backend::cpu && dynamic_cast<const GridLens*>(&other) != nullptr;
}

void GridLens::fill_both(const LensSource& other, int first_row, int row_count, const LensPixels& out,
                         const LensPixels& of_other) const {
  const auto& beside = dynamic_cast<const GridLens&>(other);
  launch(LookUpPairBatch{{rows(first_row, row_count, out), beside.rows(first_row, row_count, of_other)}});
}

}  // namespace ergodome
