#include "render/lens/direct_lens.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

constexpr double pi = 3.14159265358979323846;
//! Light that still circles after this many steps is closer to the critical curve than float can tell.
constexpr int step_limit = 200;

}  // namespace

DirectLens::DirectLens(Backend backend, const EyeCamera& eye, const Projection& projection, double tolerance_px)
    : station_(make_camera_station(eye.spin, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity)),
      edge_(backend, station_, edge_points),
      prototype_{} {
  const double pixel = pixel_angle(projection);
  prototype_.camera = converted_station<float>(station_);
  prototype_.projection = converted_projection<float>(projection);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      prototype_.frame_from_view[i][j] = static_cast<float>(eye.frame_from_view[i][j]);
    }
  }
  prototype_.edge = edge_.view();
  const double inner = prototype_.edge.smallest - 2.0 * pixel;
  const double outer = prototype_.edge.largest + 2.0 * pixel;
  prototype_.edge_cosine_highest = inner > 0.0 ? static_cast<float>(std::cos(inner)) : 2.0F;
  prototype_.edge_cosine_lowest = outer < pi ? static_cast<float>(std::cos(outer)) : -2.0F;
  prototype_.settings = {std::clamp(tolerance_px * pixel, 1e-7, 1e-4), step_limit};
}

PixelBatch DirectLens::rows(int first_row, int row_count, const LensPixels& out) const {
  PixelBatch batch = prototype_;
  batch.edge = edge_.view();
  batch.first_row = first_row;
  batch.row_count = row_count;
  batch.out = out;
  return batch;
}

}  // namespace ergodome
