// How a session writes down where its camera goes.
#include <utility>

#include "app/player/player_session.h"
#include "content/fall/within.h"

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
    return;  // keys do not lead there
  }
  const ObserverView& seen = frame_.observer;
  const bool as_observer =
      !pose.velocity && seen.motion == show_.camera.motion &&
      (seen.motion != ObserverMotion::velocity || same_velocity(seen.velocity, show_.camera.velocity));
  if (!pose.velocity) {
    pose.velocity = observer_velocity(seen.motion, show_now_.spin, pose.r, pose.theta, seen.velocity);
  }
  recorder_->note(now_s(), pose, as_observer, falling);
  if (recorder_->ended() && !std::exchange(told_record_ends_, true)) {
    say(playback_.language() == "de" ? "Die Aufzeichnung endet mit dem Fall durch den Horizont."
                                     : "The record ends with the fall through the horizon.");
  }
}

void PlayerSession::record() {
  recorder_.emplace();
  told_record_ends_ = false;
}

std::optional<Show> PlayerSession::recorded(const std::string& title) const {
  if (!recorder_ || recorder_->empty()) {
    return std::nullopt;
  }
  Show scene = show_now_;
  scene.stereo = chosen_stereo();
  return recorded_show(scene, recorder_->path(scene), title);
}

}  // namespace ergodome
