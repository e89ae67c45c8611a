#include "render/lens/direct_lens.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "kernels/spacetime/trace/trace_pixels.h"

namespace ergodome {

namespace {

//! Maximum number of steps. Light that still circles after that many is so close to the critical
//! curve that float cannot resolve it.
constexpr int direct_step_limit = 200;

}  // namespace

CameraStation station_of(const EyeCamera& eye) {
  return make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
}

PixelBatch pixel_batch(const EyeCamera& eye, const Projection& projection, double tolerance_px) {
  PixelBatch batch{};
  batch.camera = converted_station<float>(station_of(eye));
  batch.projection = converted_projection<float>(projection);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      batch.frame_from_view[i][j] = static_cast<float>(eye.frame_from_view[i][j]);
    }
  }
  batch.settings = {std::clamp(tolerance_px * pixel_angle(projection), 1e-7, 1e-4), direct_step_limit, true};
  return batch;
}

void set_sky_steps(PixelBatch& batch, const EyeCamera& eye) {
  constexpr double fastest_usual = 0.999;
  if (std::abs(eye.spacetime.spin) <= fastest_usual && eye.r > horizon_radius(eye.spacetime)) {
    batch.settings.step_limit = 48;
  }
}

void set_edge(PixelBatch& batch, const EdgeCurve& edge, const Projection& projection) {
  const double pixel = largest_pixel_angle(projection);
  const double inner = static_cast<double>(edge.smallest) - 2.0 * pixel;
  const double outer = static_cast<double>(edge.largest) + 2.0 * pixel;
  batch.edge = edge;
  batch.edge_cosine_highest = inner > 0.0 ? static_cast<float>(std::cos(inner)) : 2.0F;
  batch.edge_cosine_lowest = outer < pi ? static_cast<float>(std::cos(outer)) : -2.0F;
}

DirectLens::DirectLens(Backend backend, const EyeCamera& eye, const Projection& projection, double tolerance_px)
    : backend_(backend),
      edge_(backend, station_of(eye), edge_points),
      prototype_(pixel_batch(eye, projection, tolerance_px)) {
  set_edge(prototype_, edge_.view(), projection);
  set_sky_steps(prototype_, eye);
}

void DirectLens::fill(int first_row, int row_count, const LensPixels& out) const {
  PixelBatch batch = prototype_;
  batch.first_row = first_row;
  batch.row_count = row_count;
  batch.out = out;
  launch(backend_, batch);
}

}  // namespace ergodome
