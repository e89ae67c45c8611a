// Recording of a session's camera path.
#include <utility>

#include "app/navigation/flight_space.h"
#include "app/player/player_session.h"
#include "content/camera/camera_path.h"

namespace ergodome {

namespace {

bool same_velocity(const Vector3<double>& a, const Vector3<double>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace

std::optional<double> PlayerSession::own_time_of_fall() {
  const bool falls = frame_.pose.velocity_in_rain;
  if (const std::optional<double> on_ride = navigator_->own_time()) {
    return falls ? std::optional(own_time_before_ride_ + *on_ride) : std::nullopt;
  }
  const bool on_path = !flying() && leads_within(show_) && frame_.path_time_s;
  own_time_before_ride_ = on_path ? show_.camera.orbit->proper_time(*frame_.path_time_s) : 0.0;
  return on_path && falls ? std::optional(own_time_before_ride_) : std::nullopt;
}

void PlayerSession::note_flight() {
  CameraPose pose = frame_.pose;
  const bool beyond_return = is_beyond_return(show_now_.spin, pose.r);
  std::optional<FallingNote> falling;
  if (const std::optional<double> own_time = own_time_of_fall()) {
    falling = {*own_time, beyond_return};
  } else if (beyond_return) {
    return;  // keys cannot lead there
  }
  const ObserverView& seen = frame_.observer;
  const bool as_observer =
      !pose.velocity && seen.motion == show_.camera.motion &&
      (seen.motion != ObserverMotion::velocity || same_velocity(seen.velocity, show_.camera.velocity));
  if (!pose.velocity) {
    pose.velocity = observer_velocity(seen.motion, show_now_.spin, pose.r, pose.theta, seen.velocity);
  }
  recorder_->note({now_s(), pose, show_now_.spin, as_observer, falling});
  if (recorder_->ended() && !ended_record_scene_) {
    tell_record_ends(scene_now());
  }
}

void PlayerSession::end_record_in(const Show& scene) {
  if (recorder_ && recorder_->beyond_return() && !recorder_->ended()) {
    recorder_->end();
    tell_record_ends(scene);
  }
}

void PlayerSession::tell_record_ends(const Show& scene) {
  ended_record_scene_ = scene;
  say(playback_.language() == "de" ? "Die Aufzeichnung endet mit dem Fall durch den Horizont."
                                   : "The recording ends with the fall through the horizon.");
}

Show PlayerSession::scene_now() const {
  Show scene = show_now_;
  scene.stereo = chosen_stereo();
  return scene;
}

void PlayerSession::record() {
  recorder_.emplace();
  ended_record_scene_.reset();
}

std::optional<Show> PlayerSession::recorded(const std::string& title) const {
  if (!recorder_ || recorder_->empty()) {
    return std::nullopt;
  }
  const Show scene = ended_record_scene_ ? *ended_record_scene_ : scene_now();
  return recorded_show(scene, recorder_->path(scene), title);
}

}  // namespace ergodome
