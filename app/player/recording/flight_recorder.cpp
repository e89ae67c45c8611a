#include "app/player/recording/flight_recorder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>

#include "content/camera/rain_pose.h"
#include "content/show/stereo_eyes.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double shortest_s = 1.0 / 30.0 - 1e-4;
constexpr std::size_t max_samples = 30 * 3600;

bool is_finite(const CameraPose& pose) {
  return std::isfinite(pose.r) && std::isfinite(pose.theta) && std::isfinite(pose.phi) &&
         (!pose.velocity || dot(*pose.velocity, *pose.velocity) < 1.0) &&
         std::isfinite(pose.orientation.w + pose.orientation.x + pose.orientation.y + pose.orientation.z);
}

Show bare_path(const Show& scene) {
  Show show = scene;
  show.timeline = {};
  show.camera.keys.clear();
  show.camera.fall.reset();
  show.camera.orbit.reset();
  show.camera.after_fall.clear();
  return show;
}

//! Gives the path of `show` a fall through the given moments, and adds marks to `marks`: first of
//! the point where the keys release the camera, then of the moments after it. Returns nothing if no
//! such fall exists.
std::optional<RecordedFall> add_fall(const std::vector<FallMoment>& moments, Show& show, std::vector<PathMark>& marks) {
  const double before_s = marks.empty() ? moments.front().time_s - shortest_s : marks.back().key.time_s;
  std::optional<RecordedFall> fall = recorded_fall(spacetime_of(show), moments, before_s);
  if (!fall) {
    return std::nullopt;
  }
  if (!marks.empty()) {
    fall->start.phi += 2.0 * pi * std::round((marks.back().key.phi - fall->start.phi) / (2.0 * pi));
  }
  show.duration_s = moments.back().time_s;
  show.camera.keys = {fall->start};
  put_fall(*fall, show);
  if (!show.camera.orbit->leads_within()) {
    return std::nullopt;
  }
  const auto key_of = [&](double time_s, const CameraPose& pose) {
    // During a fall, keys give the orientation relative to a frame that is carried along the orbit.
    CameraPose relative = {fall->start.r, fall->start.theta, fall->start.phi, {}};
    relative.orientation = glm::normalize(glm::conjugate(show.camera.orbit->at(time_s).frame) * pose.orientation);
    return key_at(time_s, relative);
  };
  const CameraKey first = key_of(moments.front().time_s, moments.front().pose);
  fall->start.yaw = first.yaw;
  fall->start.pitch = first.pitch;
  fall->start.roll = first.roll;
  if (marks.empty() || !marks.front().key.velocity) {
    fall->start.velocity.reset();
  }
  marks.push_back({fall->start, camera_pose(show, fall->start.time_s)});
  for (const FallMoment& moment : moments) {
    if (moment.time_s > fall->start.time_s) {
      marks.push_back({key_of(moment.time_s, moment.pose), moment.pose});
    }
  }
  return fall;
}

//! The samples of a flight that fall through the horizon, [begin, end): all on one orbit around the
//! same hole.
struct FallingPart {
  std::size_t begin;
  std::size_t beyond;  //!< first sample that is beyond return, see is_beyond_return()
  std::size_t end;
};

FallMoment moment_of(const FlightSample& sample) { return {sample.time_s, sample.pose, sample.falling->proper_time}; }

bool is_beyond(const FlightSample& sample) { return sample.falling && sample.falling->beyond_return; }

//! Returns whether one moment leads to the other by free fall, around the same hole.
bool is_one_fall(const FlightSample& before, const FlightSample& after) {
  return before.falling && after.falling && before.spacetime == after.spacetime &&
         falls_on(before.spacetime, moment_of(before), moment_of(after));
}

//! Returns the samples of the fall to which the first sample beyond return belongs. All three
//! members are the number of samples if none is beyond return.
FallingPart falling_part(const std::vector<FlightSample>& samples) {
  const auto at = static_cast<std::size_t>(std::ranges::find_if(samples, is_beyond) - samples.begin());
  FallingPart part = {at, at, at};
  const auto goes_on = [&](std::size_t i) { return is_one_fall(samples[i], samples[i + 1]); };
  while (at < samples.size() && part.begin > 0 && goes_on(part.begin - 1)) {
    --part.begin;
  }
  while (part.end < samples.size() && (part.end == at || goes_on(part.end - 1))) {
    ++part.end;
  }
  return part;
}

std::vector<FallMoment> moments_of(std::span<const FlightSample> samples, double first_s) {
  std::vector<FallMoment> moments;
  for (const FlightSample& sample : samples) {
    moments.push_back(moment_of(sample));
    moments.back().time_s -= first_s;
  }
  return moments;
}

//! Returns marks of samples outside the horizon. The marks have no velocities if all samples have
//! the scene's observer.
std::vector<PathMark> marks_of(std::span<const FlightSample> samples, double first_s) {
  const bool as_observer = std::ranges::all_of(samples, &FlightSample::as_observer);
  std::vector<PathMark> marks;
  for (const FlightSample& sample : samples) {
    CameraPose pose = in_zamo_frame(sample.pose, sample.spacetime);
    if (as_observer) {
      pose.velocity.reset();
    }
    marks.push_back({key_at(sample.time_s - first_s, pose), pose});
  }
  return marks;
}

//! Shifts the path to begin at 0 s, because a fall may begin before the first sample.
void begin_at_0(RecordedPath& path) {
  const double first_s = path.keys.empty() ? 0.0 : path.keys.front().time_s;
  for (CameraKey& key : path.keys) {
    key.time_s -= first_s;
  }
  if (path.fall) {
    path.fall->start.time_s -= first_s;
    path.fall->settings.time_s -= first_s;
    for (NumberKey& key : path.fall->clock) {
      key.time_s -= first_s;
    }
  }
}

}  // namespace

void FlightRecorder::note(FlightSample sample) {
  if (ended_ || full() || !std::isfinite(sample.time_s) || !is_finite(sample.pose)) {
    return;
  }
  if (beyond_return() && !is_one_fall(samples_.back(), sample)) {
    ended_ = true;
    return;
  }
  if (!samples_.empty() && !(sample.time_s - samples_.back().time_s >= shortest_s)) {
    return;
  }
  sample.pose.orientation = glm::normalize(sample.pose.orientation);
  if (!samples_.empty()) {
    // Keeps azimuths continuous: a camera that crosses 2 pi, or flies over the spin axis, has not
    // gone around the hole.
    const double before = samples_.back().pose.phi;
    sample.pose.phi += 2.0 * pi * std::round((before - sample.pose.phi) / (2.0 * pi));
  }
  samples_.push_back(sample);
}

bool FlightRecorder::beyond_return() const { return !samples_.empty() && is_beyond(samples_.back()); }

bool FlightRecorder::full() const { return samples_.size() >= max_samples; }

RecordedPath FlightRecorder::path(const Show& scene, const RecordTolerance& tolerance) const {
  const FallingPart part = falling_part(samples_);
  const std::span<const FlightSample> samples = samples_;
  const double first_s = samples.empty() ? 0.0 : samples.front().time_s;
  std::vector<PathMark> marks = marks_of(samples.first(part.begin), first_s);
  const std::size_t let_go = marks.size();
  RecordedPath path;
  Show show = bare_path(scene);
  if (part.begin < part.end && samples[part.beyond].spacetime == spacetime_of(scene)) {
    path.fall = add_fall(moments_of(samples.subspan(part.begin, part.end - part.begin), first_s), show, marks);
  }
  if (path.fall) {
    path.keys = min_keys(marks, let_go, std::move(show), tolerance);
  } else {
    path.keys = min_keys(marks_of(samples.first(part.beyond), first_s), 0, bare_path(scene), tolerance);
  }
  begin_at_0(path);
  return path;
}

Show recorded_show(const Show& scene, RecordedPath path, const std::string& title) {
  Show show = bare_path(scene);
  show.title = {{"", title}};
  show.duration_s = path.keys.empty() ? 0.0 : path.keys.back().time_s;
  show.camera.keys = std::move(path.keys);
  if (path.fall) {
    put_fall(*path.fall, show);
    show.stereo.model = model_for_fall(show.stereo.model);  // as in the player
  }
  const auto position = [&](std::string& file) {
    const std::filesystem::path beside = std::filesystem::path(scene.folder) / file;
    std::error_code problem;
    if (!file.empty() && std::filesystem::exists(beside, problem)) {
      file = std::filesystem::absolute(beside, problem).lexically_normal().string();
    }
  };
  position(show.sky.map);
  position(show.sky.stars);
  if (show.effects.diffraction) {
    position(show.effects.diffraction->pattern);
  }
  return show;
}

}  // namespace ergodome
