#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "kernels/projection/make_projection.h"
#include "render/passes/near_field/near_field.h"
#include "tests/support/sanitized.h"

// Small scenes with objects drawn by rays, without a sky.
namespace ergodome::test {

inline constexpr int traced_size_px = test::sanitized ? 64 : 128;
inline constexpr double tolerance_px = 0.05;

inline ObjectSettings ball(const Vector3<double>& position, double size,
                           const Vector3<double>& color = {1.0, 1.0, 1.0}) {
  ObjectSettings object;
  object.form = ObjectForm::sphere;
  object.method = ObjectMethod::trace;
  object.position = position;
  object.size = size;
  object.color = color;
  return object;
}

inline Show show_of(double spin, std::vector<ObjectSettings> objects) {
  Show show;
  show.name = "scene";
  show.spin = spin;
  show.objects = std::move(objects);
  return show;
}

//! A picture of objects, and its projection.
struct Drawn {
  Projection projection;
  std::vector<float> rgba;

  [[nodiscard]] float at(int x, int y, int part) const {
    return rgba[4 * static_cast<std::size_t>(y * projection.width_px + x) + static_cast<std::size_t>(part)];
  }
  [[nodiscard]] float covered(int x, int y) const { return at(x, y, 3); }
};

//! Draws objects in front of black, in blocks of `rows` rows.
inline Drawn draw(const Show& show, const EyeCamera& eye, const Projection& projection, int rows = 1 << 20,
                  double time_s = 0.0) {
  Drawn drawn{projection,
              std::vector<float>(4UL * static_cast<std::size_t>(projection.width_px * projection.height_px))};
  TracedObjects objects(show, Backend::cpu);
  const ShellPass shells(show, Backend::cpu);
  const std::unique_ptr<DiskPass> disk = show.disk ? std::make_unique<DiskPass>(show, Backend::cpu) : nullptr;
  for (int row = 0; row < projection.height_px; row += rows) {
    draw_near_field(Backend::cpu, {disk.get(), show.shells.empty() ? nullptr : &shells, &objects},
                    {eye, nullptr, projection, tolerance_px, time_s}, {row, std::min(rows, projection.height_px - row)},
                    drawn.rgba.data() + 4L * row * projection.width_px);
  }
  return drawn;
}

inline Projection screen(double field_of_view) {
  return make_pinhole_projection(traced_size_px, traced_size_px, field_of_view);
}

inline Vector3<double> observed(const EyeCamera& eye, const Projection& projection, double x, double y) {
  const Vector3<double> v = direction_from_pixel(projection, x, y);
  const auto part = [&](int i) {
    return eye.frame_from_view[i][0] * v.x + eye.frame_from_view[i][1] * v.y + eye.frame_from_view[i][2] * v.z;
  };
  return {part(0), part(1), part(2)};
}

inline CameraStation station(const EyeCamera& eye) {
  return make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
}

}  // namespace ergodome::test
