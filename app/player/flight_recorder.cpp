#include "app/player/flight_recorder.h"

#include <algorithm>
#include <cmath>

#include "content/proper_velocity.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double shortest_s = 1.0 / 30.0 - 1e-4;
constexpr std::size_t most_samples = 30 * 3600;

bool is_finite(const CameraPose& pose) {
  return std::isfinite(pose.r) && std::isfinite(pose.theta) && std::isfinite(pose.phi) &&
         (!pose.velocity || dot(*pose.velocity, *pose.velocity) < 1.0) &&
         std::isfinite(pose.orientation.w + pose.orientation.x + pose.orientation.y + pose.orientation.z);
}

glm::dvec3 direction_of(const CameraPose& pose) {
  return {std::sin(pose.theta) * std::cos(pose.phi), std::sin(pose.theta) * std::sin(pose.phi), std::cos(pose.theta)};
}

//! Worst deviation of a path from a note, in tolerances.
double deviation(const CameraPose& path, const CameraPose& note, const RecordTolerance& tolerance) {
  const double turned =
      2.0 * std::acos(std::min(1.0, std::abs(glm::dot(glm::normalize(path.orientation), note.orientation))));
  const double moved = glm::length(direction_of(path) - direction_of(note));
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
  // The columns of yaw * pitch * roll, as key_orientation() multiplies them.
  const glm::dmat3 m = glm::mat3_cast(glm::normalize(glm::inverse(key_orientation(CameraKey())) * pose.orientation));
  const glm::dvec3& back = m[2];
  const double sine = std::clamp(-back.y, -1.0, 1.0);
  key.pitch = std::asin(sine);
  if (std::hypot(back.x, back.z) > 1e-9) {
    key.yaw = -std::atan2(back.x, back.z);
    key.roll = -std::atan2(m[0].y, m[1].y);
  } else {
    // Straight up or down, yaw and roll turn about the same axis.
    key.yaw = -std::atan2(-m[0].z, m[0].x);
  }
  return key;
}

void FlightRecorder::note(double time_s, const CameraPose& pose, bool as_observer) {
  if (full() || !std::isfinite(time_s) || !is_finite(pose) ||
      (!samples_.empty() && !(time_s - samples_.back().time_s >= shortest_s))) {
    return;
  }
  Sample sample = {time_s, pose, as_observer};
  sample.pose.orientation = glm::normalize(pose.orientation);
  if (!samples_.empty()) {
    // Azimuths go on from each other: a camera that crosses 2 pi, or flies over the axis, has not been round the hole.
    const double before = samples_.back().pose.phi;
    sample.pose.phi += 2.0 * pi * std::round((before - sample.pose.phi) / (2.0 * pi));
  }
  samples_.push_back(sample);
}

bool FlightRecorder::full() const { return samples_.size() >= most_samples; }

std::vector<FlightRecorder::Sample> FlightRecorder::needed() const {
  std::vector<Sample> samples = samples_;
  if (std::ranges::all_of(samples, &Sample::as_observer)) {
    for (Sample& sample : samples) {
      sample.pose.velocity.reset();
    }
  }
  return samples;
}

CameraKey FlightRecorder::key_of(const Sample& sample) const {
  return key_at(sample.time_s - samples_.front().time_s, sample.pose);
}

std::vector<CameraKey> FlightRecorder::keys(const Show& scene, const RecordTolerance& tolerance) const {
  Show path = scene;
  path.camera.orbit.reset();
  const std::vector<Sample> samples = needed();
  std::vector<std::size_t> chosen = {0};
  if (samples.size() > 1) {
    chosen.push_back(samples.size() - 1);
  }
  while (true) {
    path.camera.keys.clear();
    for (const std::size_t i : chosen) {
      path.camera.keys.push_back(key_of(samples[i]));
    }
    // The worst note of every span becomes a key, until there is none that is bad.
    std::vector<std::size_t> more;
    for (std::size_t span = 0; span + 1 < chosen.size(); ++span) {
      double worst = 1.0;
      std::size_t where = 0;
      for (std::size_t i = chosen[span] + 1; i < chosen[span + 1]; ++i) {
        const double time_s = samples[i].time_s - samples_.front().time_s;
        const double off = deviation(camera_pose(path, time_s), samples[i].pose, tolerance);
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
    std::sort(chosen.begin(), chosen.end());
  }
}

Show recorded_show(const Show& scene, std::vector<CameraKey> keys, const std::string& title) {
  Show show = scene;
  show.title = title;
  show.timeline = {};
  show.duration_s = keys.empty() ? 0.0 : keys.back().time_s;
  show.camera.keys = std::move(keys);
  show.camera.fall.reset();
  show.camera.orbit.reset();
  show.camera.after_fall.clear();
  const auto place = [&](std::string& file) {
    const std::filesystem::path beside = std::filesystem::path(scene.folder) / file;
    std::error_code problem;
    if (!file.empty() && std::filesystem::exists(beside, problem)) {
      file = std::filesystem::absolute(beside, problem).lexically_normal().string();
    }
  };
  place(show.sky.map);
  place(show.sky.stars);
  if (show.effects.diffraction) {
    place(show.effects.diffraction->pattern);
  }
  return show;
}

}  // namespace ergodome
