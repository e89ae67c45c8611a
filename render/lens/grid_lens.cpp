#include "render/lens/grid_lens.h"

#include <utility>

#include "render/lens/direct_lens.h"

namespace ergodome {

StationBuffers::StationBuffers(Backend backend, const LensStation& station)
    : grid_(grid_view(station)),
      edge_(backend, station.edge),
      tree_(backend, station.tree),
      leaves_(backend, station.leaves),
      nodes_(backend, station.nodes) {}

LensGrid StationBuffers::view() const {
  LensGrid grid = grid_;
  grid.chart.edge.polar_angle = edge_.data();
  grid.tree = tree_.data();
  grid.leaves = leaves_.data();
  grid.nodes = nodes_.data();
  return grid;
}

GridLens::GridLens(Backend backend, std::shared_ptr<const StationBuffers> station, const EyeCamera& eye,
                   const Projection& projection, double tolerance_px)
    : backend_(backend),
      station_(std::move(station)),
      prototype_{
          pixel_batch(eye, projection, tolerance_px), station_->view(),
          converted_aberration<float>(aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity))} {}

void GridLens::fill(int first_row, int row_count, const LensPixels& out) const {
  LookUpBatch batch = prototype_;
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  batch.pixels.out = out;
  look_up_pixels(backend_, batch);
}

}  // namespace ergodome
