#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/projection/pixel_measure.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/render/ray_mesh.h"

// Measures how strongly the exact lens varies around positions on the screen.
namespace ergodome::test {

//! A position on the screen.
struct ScreenPosition {
  double x_px;
  double y_px;
};

//! Converts a direction of the view to the axes of the observer's frame.
inline Vector3<double> in_frame(const EyeCamera& eye, const Vector3<double>& view) {
  const auto along = [&](int axis) {
    const auto& row = eye.frame_from_view[axis];
    return row[0] * view.x + row[1] * view.y + row[2] * view.z;
  };
  return {along(0), along(1), along(2)};
}

inline ScreenPosition on_screen(const EyeCamera& eye, const Projection& projection, const Vector3<float>& direction) {
  const Vector3<double> n = unit_of(widened(direction));
  const auto along = [&](int axis) {
    return n.x * eye.frame_from_view[0][axis] + n.y * eye.frame_from_view[1][axis] + n.z * eye.frame_from_view[2][axis];
  };
  ScreenPosition position{};
  pixel_from_direction(projection, {along(0), along(1), along(2)}, position.x_px, position.y_px);
  return position;
}

//! The exact lens of an eye, for measurements around positions on the screen.
class LensAbout {
 public:
  //! changes() returns infinity for positions that are closer to the edge of the shadow than
  //! `min_edge_px`.
  LensAbout(const EyeCamera& eye, const Projection& projection, double min_edge_px)
      : eye_(eye), projection_(projection), shadow_(camera_of(eye)), min_edge_px_(min_edge_px) {}

  //! Returns the variation of the magnification across a pixel around each position: maximum minus
  //! minimum, divided by the minimum. Infinite where the parity changes, and near the edge of the
  //! shadow.
  [[nodiscard]] std::vector<double> changes(const std::vector<ScreenPosition>& asked) const {
    constexpr double step = 0.05;
    // Traces three rays at each corner of the pixel around a position: at the corner, to its right
    // and below it.
    constexpr std::size_t rays = 12;
    const std::size_t count = rays * asked.size();
    std::vector<double> values(6 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t corner = (i % rays) / 3;
      const std::size_t ray = i % 3;
      const double x = asked[i / rays].x_px + (corner % 2 == 0 ? -0.5 : 0.5) + (ray == 1 ? step : 0.0);
      const double y = asked[i / rays].y_px + (corner / 2 == 0 ? -0.5 : 0.5) + (ray == 2 ? step : 0.0);
      const Vector3<double> n = in_frame(eye_, direction_from_pixel(projection_, x, y));
      const double parts[3] = {n.x, n.y, n.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        values[axis * count + i] = parts[axis];
      }
    }
    RayBatch<double> batch{};
    batch.camera = camera_of(eye_);
    batch.settings = {1e-11, 400, true};
    batch.method = TraceMethod::taylor;
    batch.count = static_cast<int>(count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      batch.direction[axis] = values.data() + axis * count;
      batch.sky[axis] = values.data() + (3 + axis) * count;
    }
    launch(Backend::cpu, batch);
    std::vector<double> changes;
    changes.reserve(asked.size());
    for (std::size_t position = 0; position < asked.size(); ++position) {
      changes.push_back(change(values, count, rays * position));
    }
    return changes;
  }

 private:
  [[nodiscard]] double change(const std::vector<double>& values, std::size_t count, std::size_t first) const {
    const auto at = [&](std::size_t channel, std::size_t ray) {
      return Vector3<double>{values[channel * count + ray], values[(channel + 1) * count + ray],
                             values[(channel + 2) * count + ray]};
    };
    double minimum = 1e300;
    double maximum = -1e300;
    for (std::size_t ray = first; ray < first + 12; ray += 3) {
      const Vector3<double> sky = at(3, ray);
      const Vector3<double> n = at(0, ray);
      if (dot(sky, sky) < 0.5 || shadow_.of(n) < min_edge_px_ * pixel_angle(projection_)) {
        return INFINITY;
      }
      // Ratio of the signed areas on the sky and on the screen.
      const double rate = dot(sky, cross(at(3, ray + 1) - sky, at(3, ray + 2) - sky)) /
                          dot(n, cross(at(0, ray + 1) - n, at(0, ray + 2) - n));
      minimum = std::min(minimum, rate);
      maximum = std::max(maximum, rate);
    }
    return minimum * maximum > 0.0 ? (maximum - minimum) / std::min(std::abs(minimum), std::abs(maximum)) : INFINITY;
  }

  EyeCamera eye_;
  Projection projection_;
  ShadowDistance shadow_;
  double min_edge_px_;
};

}  // namespace ergodome::test
