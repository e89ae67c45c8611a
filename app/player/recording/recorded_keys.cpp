#include "app/player/recording/recorded_keys.h"

#include <algorithm>
#include <cmath>

#include "content/camera/proper_velocity.h"

namespace ergodome {

namespace {

glm::dvec3 direction_of_pose(const CameraPose& pose) {
  return {std::sin(pose.theta) * std::cos(pose.phi), std::sin(pose.theta) * std::sin(pose.phi), std::cos(pose.theta)};
}

//! Returns the largest deviation of a path from a sample, in units of the tolerance. For a sample
//! in a fall through the horizon, only the orientation counts.
double deviation(const CameraPose& path, const CameraPose& note, const RecordTolerance& tolerance) {
  const double turned =
      2.0 * std::acos(std::min(1.0, std::abs(glm::dot(glm::normalize(path.orientation), note.orientation))));
  if (note.velocity_in_rain) {
    return turned / tolerance.turn_rad;  // an orbit determines the position, not the keys
  }
  const double moved = glm::length(direction_of_pose(path) - direction_of_pose(note));
  const double radius = std::abs(path.r / note.r - 1.0);
  double speed = 0.0;
  if (note.velocity) {
    const Vector3<double> apart = proper_velocity(*path.velocity) - proper_velocity(*note.velocity);
    speed = std::sqrt(dot(apart, apart));
  }
  return std::max(
      {speed / tolerance.velocity, turned / tolerance.turn_rad, moved / tolerance.turn_rad, radius / tolerance.radius});
}

}  // namespace

CameraKey key_at(double time_s, const CameraPose& pose) {
  CameraKey key;
  key.time_s = time_s;
  key.r = pose.r;
  key.theta = pose.theta;
  key.phi = pose.phi;
  key.velocity = pose.velocity;
  // The matrix of the rotations by yaw, pitch and roll, multiplied as in key_orientation(): its
  // columns are the view's axes (right, up, back), relative to looking at the hole.
  const glm::dmat3 m = glm::mat3_cast(glm::normalize(glm::inverse(key_orientation(CameraKey())) * pose.orientation));
  const glm::dvec3& back = m[2];
  const double sine = std::clamp(-back.y, -1.0, 1.0);
  key.pitch = std::asin(sine);
  if (std::hypot(back.x, back.z) > 1e-9) {
    key.yaw = -std::atan2(back.x, back.z);
    key.roll = -std::atan2(m[0].y, m[1].y);
  } else {
    // Straight up or down, yaw and roll rotate about the same axis.
    key.yaw = -std::atan2(-m[0].z, m[0].x);
  }
  return key;
}

std::vector<CameraKey> min_keys(const std::vector<PathMark>& marks, std::size_t always, Show path,
                                const RecordTolerance& tolerance) {
  if (marks.empty()) {
    return {};
  }
  std::vector<std::size_t> chosen = {0, always, marks.size() - 1};
  while (true) {
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    path.camera.keys.clear();
    for (const std::size_t i : chosen) {
      path.camera.keys.push_back(marks[i].key);
    }
    // Makes the worst mark of every span a key, until all are within the tolerance.
    std::vector<std::size_t> more;
    for (std::size_t span = 0; span + 1 < chosen.size(); ++span) {
      double worst = 1.0;
      std::size_t where = 0;
      for (std::size_t i = chosen[span] + 1; i < chosen[span + 1]; ++i) {
        const double off = deviation(camera_pose(path, marks[i].key.time_s), marks[i].pose, tolerance);
        if (off > worst) {
          worst = off;
          where = i;
        }
      }
      if (where != 0) {
        more.push_back(where);
      }
    }
    if (more.empty()) {
      return path.camera.keys;
    }
    chosen.insert(chosen.end(), more.begin(), more.end());
  }
}

}  // namespace ergodome
