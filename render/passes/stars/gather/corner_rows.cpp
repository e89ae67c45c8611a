#include "render/passes/stars/gather/corner_rows.h"

#include <algorithm>

#include "kernels/launch/launch.h"
#include "kernels/projection/pixel_measure.h"

namespace ergodome {

namespace {

//! Error of the rays as a displacement of directions on the screen. The relative error of a
//! polygon's area is a few times as large.
constexpr double tolerance_px = 1e-5;
constexpr int corner_step_limit = 400;

}  // namespace

void CornerRows::trace(int first_row, int row_count) {
  // The bottom corners of the previous rows are the top corners of the new rows.
  const std::size_t kept = corners_.empty() ? 0 : width_;
  std::copy(corners_.end() - static_cast<std::ptrdiff_t>(kept), corners_.end(), corners_.begin());
  corners_.resize(width_ * static_cast<std::size_t>(row_count + 1));
  first_row_ = first_row;
  std::vector<std::size_t> asked;
  for (std::size_t i = kept; i < corners_.size(); ++i) {
    corners_[i].seen = false;
    if (is_needed(i)) {
      asked.push_back(i);
    }
  }
  trace(asked);
}

bool CornerRows::is_needed(std::size_t i) const {
  const double x = column_of(i);
  const double y = row_of(i);
  return image_coverage(projection_, x - 0.5, y - 0.5) > 0.0 || image_coverage(projection_, x + 0.5, y - 0.5) > 0.0 ||
         image_coverage(projection_, x - 0.5, y + 0.5) > 0.0 || image_coverage(projection_, x + 0.5, y + 0.5) > 0.0;
}

void CornerRows::trace(const std::vector<std::size_t>& asked) {
  const EyeCamera& camera = eye_.camera;
  const std::size_t count = asked.size();
  std::vector<double> values(8 * count);
  const auto channel = [&](std::size_t i) { return values.data() + i * count; };
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3<double> view = direction_from_pixel(projection_, column_of(asked[i]), row_of(asked[i]));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& row = camera.frame_from_view[axis];
      channel(axis)[i] = row[0] * view.x + row[1] * view.y + row[2] * view.z;
    }
  }
  RayBatch<double> batch{};
  batch.camera =
      make_camera_station(camera.spacetime, camera.r, camera.theta, camera.phi, camera.motion, camera.velocity);
  batch.settings = {tolerance_px * pixel_angle(projection_), corner_step_limit, true};
  batch.method = TraceMethod::taylor;
  batch.count = static_cast<int>(count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    batch.direction[axis] = channel(axis);
    batch.sky[axis] = channel(3 + axis);
  }
  batch.frequency_ratio = channel(6);
  batch.status = channel(7);
  if (eye_.omni) {
    launch(OmniRayBatch{batch, eye_.omni->cameras->exact(eye_.omni->side)});
  } else {
    launch(Backend::cpu, batch);
  }
  for (std::size_t i = 0; i < count; ++i) {
    corners_[asked[i]] = {{channel(3)[i], channel(4)[i], channel(5)[i]},
                          channel(6)[i],
                          channel(7)[i] == static_cast<double>(LightEnd::sky)};
  }
}

}  // namespace ergodome
