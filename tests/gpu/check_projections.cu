#include "kernels/projection/pixel_measure.h"
#include "tests/gpu/harness.cuh"
#include "tests/support/projections.h"

namespace ergodome::gpu_check {

namespace {

constexpr int values_a_pixel = 5;

//! Computes for each pixel its direction, its solid angle relative to that of the middle pixel, and
//! its coverage.
struct LookThroughPixels {
  ProjectionOf<float> projection;
  float inverse_square;
  float* out;

  ERGO_HD void operator()(int index) const {
    float x_px = 0.0F;
    float y_px = 0.0F;
    pixel_middles(projection.width_px, 0, projection.width_px * projection.height_px, index, x_px, y_px);
    const Vector3<float> view = direction_from_pixel(projection, x_px, y_px);
    float* to = out + values_a_pixel * static_cast<long>(index);
    to[0] = view.x;
    to[1] = view.y;
    to[2] = view.z;
    to[4] = image_coverage(projection, x_px, y_px);
    // Near the rim of a lens that sees the whole sky, directions change faster across pixels than
    // float resolves; outside the rim, they are meaningless.
    to[3] = to[4] < 1.0F ? 0.0F : inverse_square * pixel_solid_angle(projection, x_px, y_px);
  }
};

bool check_projection(const test::NamedProjection& named) {
  const Projection& p = named.projection;
  const int count = p.width_px * p.height_px;
  const double angle = pixel_angle(p);
  Twin<float> values(values_a_pixel * static_cast<std::size_t>(count));
  LookThroughPixels on_host{converted_projection<float>(p), static_cast<float>(1.0 / (angle * angle)),
                            values.host.data()};
  LookThroughPixels on_device = on_host;
  on_device.out = values.device();
  const double device_ms = run_on_device_ms("look_through_pixels", on_device, count);
  const double host_ms = run_on_host_ms(on_host, count);
  return report(named.name, count, device_ms, host_ms, compare(values.download(), values.host, 0.999, 1e-4));
}

}  // namespace

bool check_projections() {
  bool good = true;
  for (const test::NamedProjection& named : test::every_projection()) {
    good = check_projection(named) && good;
  }
  return good;
}

}  // namespace ergodome::gpu_check
