#include "render/accuracy/references/pixel_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "render/accuracy/scene.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

namespace {

using RayDual = Dual<double>;

Vector3<RayDual> in_frame(const EyeCamera& eye, const Vector3<RayDual>& view) {
  const auto row = [&](int i) {
    const double(&m)[3] = eye.frame_from_view[i];
    return view.x * m[0] + view.y * m[1] + view.z * m[2];
  };
  return {row(0), row(1), row(2)};
}

Vector3<double> value_part(const Vector3<RayDual>& v) { return {v.x.value, v.y.value, v.z.value}; }
Vector3<double> x_part(const Vector3<RayDual>& v) { return {v.x.along_x, v.y.along_x, v.z.along_x}; }
Vector3<double> y_part(const Vector3<RayDual>& v) { return {v.x.along_y, v.y.along_y, v.z.along_y}; }

//! Components of the vectors of many rays: one array per component.
using Components = std::array<std::vector<double>, 3>;

}  // namespace

PixelReference::PixelReference(const EyeCamera& eye, const Projection& projection,
                               const std::vector<std::int64_t>& pixels, double pixel)
    : pixel_(pixel), points_(pixels.size()) {
  place_points(eye, projection, pixels);
  // The closed form yields the origin of the light, independently of the series from which the
  // derivatives come.
  const std::size_t count = pixels.size();
  Components n;
  Components sky;
  std::vector<double> status(count);
  for (std::size_t k = 0; k < 3; ++k) {
    n[k].resize(count);
    sky[k].resize(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = pixel_middle(pixels[i], projection.width_px);
    const Vector3<double> direction =
        value_part(in_frame(eye, direction_from_pixel(projection, RayDual(x), RayDual(y))));
    n[0][i] = direction.x;
    n[1][i] = direction.y;
    n[2][i] = direction.z;
  }
  RayBatch<double> batch{};
  batch.camera = station_of(eye);
  batch.settings = {1e-14, 1'000'000};
  batch.method = TraceMethod::closed_form;
  batch.count = static_cast<int>(count);
  for (std::size_t k = 0; k < 3; ++k) {
    batch.direction[k] = n[k].data();
    batch.sky[k] = sky[k].data();
  }
  batch.status = status.data();
  launch(Backend::cpu, batch);
  for (std::size_t i = 0; i < count; ++i) {
    const bool escaped = status[i] == static_cast<double>(LightEnd::sky);
    points_[i].counts = points_[i].counts && escaped == points_[i].lit;
    points_[i].sky = escaped ? Vector3<double>{sky[0][i], sky[1][i], sky[2][i]} : Vector3<double>{};
  }
}

void PixelReference::place_points(const EyeCamera& eye, const Projection& projection,
                                  const std::vector<std::int64_t>& pixels) {
  const CameraStation camera = station_of(eye);
  const ShadowChart chart = make_shadow_chart(camera);
  const double side_px = largest_pixel_angle(projection) / pixel_;
  parallel_for(static_cast<int>(pixels.size()), 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      Point& point = points_[at];
      const auto [x, y] = pixel_middle(pixels[at], projection.width_px);
      if (!(image_coverage(projection, x, y) >= 1.0)) {
        continue;
      }
      const Vector3<RayDual> view = direction_from_pixel(projection, RayDual(x, 1.0, 0.0), RayDual(y, 0.0, 1.0));
      const Vector3<RayDual> n = in_frame(eye, view);
      const double edge = edge_distance(camera, chart, value_part(n));
      point.edge_px = std::abs(edge) / pixel_;
      point.lit = edge > 0.0;
      point.counts = point.edge_px > side_px;
      point.view_x = x_part(view);
      point.view_y = y_part(view);
      if (!point.lit) {
        continue;
      }
      double steps = 0.0;
      bool reached = false;
      const RayEnd<RayDual> ray =
          trace_taylor<20>(camera.spin, start_ray(camera, n), true, {1e-10, 5000}, steps, reached);
      const Vector3<RayDual> sky = turned_to_camera(camera, ray.sky);
      point.sky_x = x_part(sky);
      point.sky_y = y_part(sky);
      point.counts = point.counts && reached;
    }
  });
}

Vector3<double> PixelReference::miss(std::size_t i, const std::optional<Vector3<double>>& seen) const {
  const Point& point = points_[i];
  if (seen.has_value() != point.lit) {
    return {point.edge_px, 0.0, 0.0};
  }
  if (!seen) {
    return {0.0, 0.0, 0.0};
  }
  const Vector3<double> off = *seen - point.sky;
  const Vector3<double> normal = cross(point.sky_x, point.sky_y);
  const double inverse = 1.0 / dot(normal, normal);
  const double xx = dot(point.sky_x, point.sky_x);
  const double xy = dot(point.sky_x, point.sky_y);
  const double yy = dot(point.sky_y, point.sky_y);
  const double along_x = (yy * dot(point.sky_x, off) - xy * dot(point.sky_y, off)) * inverse;
  const double along_y = (xx * dot(point.sky_y, off) - xy * dot(point.sky_x, off)) * inverse;
  return (1.0 / pixel_) * (along_x * point.view_x + along_y * point.view_y);
}

}  // namespace ergodome
