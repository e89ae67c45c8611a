// What a session shows at an instant: camera, observer and stereo.
#include <algorithm>
#include <cmath>

#include "app/player/player_session.h"
#include "content/camera/key_curve.h"
#include "content/fall/rain_pose.h"
#include "content/show/animated_show.h"
#include "render/passes/overlay/overlay_place.h"

namespace ergodome {

namespace {

constexpr double wheel_zoom = 0.1;  //!< change of ln(field of view) per step
constexpr double narrowest_deg = 0.01;
constexpr double widest_screen_deg = 170.0;
constexpr double widest_dome_deg = 360.0;

}  // namespace

bool PlayerSession::has_words_at(double time_s) const {
  const auto is_there = [&](const auto& word) { return presence_at(word.presence, time_s) > 0.0; };
  const Timeline& timeline = show_.timeline;
  return (playback_.captions() && std::ranges::any_of(timeline.captions, is_there)) ||
         std::ranges::any_of(timeline.overlays, is_there);
}

void PlayerSession::look(double seconds, double shown_time_s) {
  const double time_s = show_.duration_s > 0.0 ? seconds_of(playback_.instant().time) : 0.0;
  const std::string& language = playback_.language();
  // Off the show's path, a picture need not be rendered again if nothing in the scene changes with
  // time.
  const bool alike = flying() && !changes_by_itself(show_) && !has_words_at(time_s) && !has_words_at(shown_time_s);
  frame_.time_s = alike ? shown_time_s : time_s;
  frame_.pose = navigator_->pose();
  if (!flying()) {
    frame_.path_time_s = time_s;
  }
  observe(seconds, time_s);
  frame_.mode = mode_;
  frame_.field_of_view_deg = field_of_view_deg();
  frame_.stereo = stereo_now();
  frame_.exposure_stops = playback_.exposure_stops();
  frame_.language = language;
  frame_.captions = playback_.captions();
  frame_.light = playback_.light();
}

void PlayerSession::observe(double seconds, double time_s) {
  // Inside the horizon, only infalling observers exist.
  const bool within = !(frame_.pose.r > horizon_radius(show_now_.spin));
  const ObserverMode mode = within ? ObserverMode::natural : observer_;
  const CameraPose in_zamo = in_zamo_frame(frame_.pose, show_now_.spin);
  const ObserverView wanted = observer_view(mode, show_.camera, own_observer(in_zamo, time_s), show_now_.spin,
                                            frame_.pose.r, frame_.pose.theta, playback_.language());
  frame_.observer = observer_fade_.advance(seconds, wanted, show_now_.spin, frame_.pose);
  if (!frame_.pose.velocity_in_rain) {
    other_eyes_from_r_ = frame_.pose.r;
  }
  const bool falls_off_path = flying() && frame_.pose.velocity_in_rain;
  if (mode != ObserverMode::natural || (falls_off_path && !within && observer_fade_.fading())) {
    look_as_other(in_zamo);
  } else if (!flying()) {
    // Baked lenses are for the show's observer.
    frame_.observer.motion = show_.camera.motion;
    frame_.observer.velocity = show_.camera.velocity;
  }
}

std::optional<ObserverView> PlayerSession::own_observer(const CameraPose& in_zamo, double time_s) const {
  const std::string& language = playback_.language();
  if (navigator_->course() == Navigator::Course::free) {
    return navigator_->own_observer(language);
  }
  if (!(in_zamo.r > horizon_radius(show_now_.spin))) {
    return falling_within(language);
  }
  // While returning to a path with velocities, the observer already moves as the path does, so that
  // nothing jumps when the path is reached.
  const std::optional<Vector3<double>> moves = navigator_->course() == Navigator::Course::returning
                                                   ? in_zamo_frame(camera_pose(show_, time_s), show_now_.spin).velocity
                                                   : in_zamo.velocity;
  return moves ? std::optional(observer_at(*moves)) : std::nullopt;
}

void PlayerSession::look_as_other(const CameraPose& in_zamo) {
  const double horizon = horizon_radius(show_now_.spin);
  const double nearest = 1.002 * horizon;
  const double farthest = std::min(1.3 * horizon, other_eyes_from_r_);
  const double r = in_zamo.r;
  const double nearness = !frame_.pose.velocity_in_rain || r >= farthest ? 0.0
                          : r <= nearest                                 ? 1.0
                                                                         : eased((farthest - r) / (farthest - nearest));
  if (nearness == 1.0) {
    return;
  }
  const Vector3<double> falls = in_zamo.velocity.value_or(Vector3<double>{});
  frame_.pose = in_zamo;
  frame_.pose.velocity.reset();
  if (nearness > 0.0) {
    const ObserverView& seen = frame_.observer;
    const Vector3<double> other = observer_velocity(seen.motion, show_now_.spin, r, frame_.pose.theta, seen.velocity);
    frame_.pose.velocity = other + nearness * (falls - other);
  }
}

ObserverView PlayerSession::observer_at(const Vector3<double>& velocity) const {
  const std::string& language = playback_.language();
  return show_.camera.orbit != nullptr ? falling_observer(velocity, language)
                                       : observer_of(ObserverMotion::velocity, velocity, show_now_.spin, frame_.pose.r,
                                                     frame_.pose.theta, language);
}

double PlayerSession::field_of_view_deg() const {
  const double widest = show_.view.projection == ViewProjection::pinhole ? widest_screen_deg : widest_dome_deg;
  return std::clamp(show_now_.view.field_of_view_deg * std::exp(-wheel_zoom * zoom_steps_), narrowest_deg,
                    std::max(widest, show_now_.view.field_of_view_deg));
}

StereoSettings PlayerSession::chosen_stereo() const {
  StereoSettings stereo = stereo_;
  stereo.baseline = playback_.baseline().value_or(show_now_.stereo.baseline);
  stereo.convergence = convergence_.value_or(show_now_.stereo.convergence);
  return stereo;
}

StereoSettings PlayerSession::stereo_now() const {
  StereoSettings stereo = chosen_stereo();
  if (options_.plain_window && stereo.layout == StereoLayout::quad_buffer) {
    stereo.layout = StereoLayout::side_by_side;
  }
  const bool may_be_within = leads_within(show_) || navigator_->pose().velocity_in_rain;
  if (may_be_within && stereo.model == StereoModel::flat) {
    stereo.model = StereoModel::physical;  // flat eyes are undefined inside the horizon
  }
  return stereo;
}

}  // namespace ergodome
