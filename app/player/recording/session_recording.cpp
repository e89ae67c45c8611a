#include "app/player/recording/session_recording.h"

#include "app/navigation/flight_space.h"
#include "content/camera/camera_path.h"

namespace ergodome {

namespace {

bool same_velocity(const Vector3<double>& a, const Vector3<double>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace

void SessionRecording::begin() {
  recorder_.emplace();
  ended_in_.reset();
}

std::optional<double> SessionRecording::proper_time_of_fall(const PlayerFrame& frame, const Navigator& navigator,
                                                            const Show& show) {
  const bool falls = frame.pose.velocity_in_rain;
  if (const std::optional<double> on_ride = navigator.proper_time()) {
    return falls ? std::optional(proper_time_before_ride_ + *on_ride) : std::nullopt;
  }
  const bool on_path = navigator.course() == Navigator::Course::path && leads_within(show) && frame.path_time_s;
  proper_time_before_ride_ = on_path ? show.camera.orbit->proper_time(*frame.path_time_s) : 0.0;
  return on_path && falls ? std::optional(proper_time_before_ride_) : std::nullopt;
}

bool SessionRecording::note(double now_s, const PlayerFrame& frame, const Navigator& navigator, const Show& show,
                            Spacetime spacetime) {
  if (!recorder_) {
    return false;
  }
  CameraPose pose = frame.pose;
  const bool beyond_return = is_beyond_return(spacetime, pose.r);
  std::optional<FallingNote> falling;
  if (const std::optional<double> proper_time = proper_time_of_fall(frame, navigator, show)) {
    falling = {*proper_time, beyond_return};
  } else if (beyond_return) {
    return false;  // camera keys cannot lead that close to the hole
  }
  const ObserverView& seen = frame.observer;
  const bool as_observer =
      !pose.velocity && seen.motion == show.camera.motion &&
      (seen.motion != ObserverMotion::velocity || same_velocity(seen.velocity, show.camera.velocity));
  if (!pose.velocity) {
    pose.velocity = observer_velocity(seen.motion, spacetime, pose.r, pose.theta, seen.velocity);
  }
  recorder_->note({now_s, pose, spacetime, as_observer, falling});
  return recorder_->ended() && !ended_in_;
}

void SessionRecording::end(const Show& scene) {
  recorder_->end();
  ended_in_ = scene;
}

std::optional<Show> SessionRecording::recorded(const Show& scene, const std::string& title) const {
  if (!recorder_ || recorder_->empty()) {
    return std::nullopt;
  }
  const Show& flown = ended_in_ ? *ended_in_ : scene;
  return recorded_show(flown, recorder_->path(flown), title);
}

}  // namespace ergodome
