#include "app/player/player_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/player/stereo_controls.h"
#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "render/passes/overlay/overlay_position.h"

namespace ergodome {

namespace {

constexpr double message_s = 4.0;
constexpr double wheel_zoom = 0.1;  //!< change of ln(field of view) per step
constexpr double narrowest_deg = 0.01;
constexpr double widest_screen_deg = 170.0;
constexpr double widest_dome_deg = 360.0;

bool same_vector(const Vector3<double>& a, const Vector3<double>& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool same_pose(const CameraPose& a, const CameraPose& b) {
  return a.r == b.r && a.theta == b.theta && a.phi == b.phi && a.orientation == b.orientation &&
         a.velocity.has_value() == b.velocity.has_value() && (!a.velocity || same_vector(*a.velocity, *b.velocity));
}

bool same_observer(const ObserverView& a, const ObserverView& b) {
  return a.motion == b.motion && same_vector(a.velocity, b.velocity);
}

//! Returns whether two frames need the same picture. The display's light does not affect pictures.
bool same_picture(const PlayerFrame& a, const PlayerFrame& b) {
  return a.time_s == b.time_s && same_pose(a.pose, b.pose) && same_observer(a.observer, b.observer) &&
         a.mode == b.mode && a.field_of_view_deg == b.field_of_view_deg && a.path_time_s == b.path_time_s &&
         a.stereo == b.stereo && a.exposure_stops == b.exposure_stops && a.language == b.language &&
         a.captions == b.captions;
}

bool does_something(const Steering& steering) { return steering != Steering(); }

//! Returns whether the camera is to move or turn.
bool steers(Steering steering) {
  steering.zoom = 0.0;
  steering.faster = 0.0;
  return steering != Steering();
}

}  // namespace

PlayerSession::PlayerSession(const Show& show, SessionOptions options)
    : options_(std::move(options)),
      show_(show),
      show_now_(show_at(show, 0.0)),
      playback_(show, {.language = options_.language, .source = options_.source}),
      stereo_(show.stereo) {
  navigator_.emplace(show_now_);
  if (options_.free_flight) {
    navigator_->leave_path();
  }
  update_frame(0.0, 0.0);
}

void PlayerSession::set_show(const Show& show) {
  const bool was_flying = flying();
  const Show scene_before = scene_now();
  show_ = show;
  show_now_ = show_at(show, picture_time_s());
  stereo_ = show.stereo;
  convergence_.reset();
  playback_.set_show(show);
  navigator_.emplace(show_now_);
  if (was_flying) {
    navigator_->leave_path();
  }
  const bool another_hole = spacetime() != spacetime_of(scene_before) || find_animation(show_, "hole.spin") != nullptr;
  if (another_hole && recording_.is_bound_to_hole()) {
    end_recording(scene_before);
  }
  changed_ = true;
  begun_ = false;
}

void PlayerSession::advance(const PlayerInput& input) {
  const double before_s = now_s();
  display_delay_s_ = input.display_delay_s;
  playback_.advance();
  for (const TransportCommand& command : input.commands) {
    apply(command);
  }
  for (const KeyAction action : input.actions) {
    press(action);
  }
  if (!input.actions.empty() || does_something(input.steering.rates) || does_something(input.steering.amounts)) {
    touched_s_ = now_s();
  }
  playback_.advance();
  const double seconds = std::max(now_s() - before_s, 0.0);
  navigate(input, seconds);
  report_replaced_eyes();
  const PlayerFrame before = std::exchange(frame_, {});
  update_frame(seconds, before.time_s);
  changed_ = !begun_ || !same_picture(before, frame_);
  begun_ = true;
  if (recording_.note(now_s(), frame_, *navigator_, show_, spacetime())) {
    end_recording(scene_now());
  }
}

double PlayerSession::picture_time_s() const {
  if (!(show_.duration_s > 0.0)) {
    return 0.0;
  }
  const ShowInstant& instant = playback_.instant();
  const double now_s = seconds_of(instant.time);
  return std::min(now_s + instant.speed * display_delay_s_, std::max(now_s, show_.duration_s));
}

void PlayerSession::navigate(const PlayerInput& input, double seconds) {
  const double time_s = picture_time_s();
  animate(show_now_, time_s);
  zoom_steps_ += input.steering.amounts.zoom + 5.0 * seconds * std::clamp(input.steering.rates.zoom, -1.0, 1.0);
  zoom_steps_ = std::clamp(zoom_steps_, -100.0, 150.0);
  if (steers(input.steering.rates) || steers(input.steering.amounts)) {
    navigator_->leave_path();
  }
  navigator_->set_spacetime(spacetime());
  if (input.look) {
    navigator_->look(*input.look);
  }
  navigator_->advance(seconds, input.steering, camera_pose(show_, time_s));
}

bool PlayerSession::moving() const {
  return changed_ || navigator_->moved() || (!flying() && playback_.instant().playing && show_.duration_s > 0.0);
}

void PlayerSession::apply(const TransportCommand& command) {
  switch (playback_.apply(command)) {
    case CommandOutcome::refused:
      say(playback_.refusal());
      return;
    case CommandOutcome::done:
      if (command.kind == TransportCommand::Kind::next_language) {
        say(playback_.language());
      }
      return;
    case CommandOutcome::elsewhere:
      break;
  }
  switch (command.kind) {
    case TransportCommand::Kind::free_flight:
      navigator_->leave_path();
      break;
    case TransportCommand::Kind::return_to_path:
      navigator_->return_to_path();
      break;
    case TransportCommand::Kind::reset:
      convergence_.reset();
      stereo_ = show_.stereo;
      zoom_steps_ = 0.0;
      observer_.reset();
      mode_ = ViewMode::sky;
      if (flying()) {
        navigator_->reset();
      }
      break;
    case TransportCommand::Kind::reload:
      requests_.push_back(KeyAction::reload);
      break;
    default:
      break;
  }
}

void PlayerSession::press(KeyAction action) {
  PlayerStatus status;
  fill(status);
  if (action == KeyAction::reload) {
    requests_.push_back(action);
  } else if (action == KeyAction::captions) {
    apply({TransportCommand::Kind::captions, playback_.captions() ? 0.0 : 1.0, {}});
  } else if (const auto command = transport_command(action, status)) {
    apply(*command);
  } else {
    press_view(action);
  }
}

void PlayerSession::press_view(KeyAction action) {
  const std::string& language = playback_.language();
  switch (action) {
    case KeyAction::quit:
    case KeyAction::full_screen:
    case KeyAction::leave_exhibit:
      requests_.push_back(action);
      break;
    case KeyAction::help:
      help_shown_ = !help_shown_;
      break;
    case KeyAction::times:
      times_shown_ = !times_shown_;
      changed_ = true;
      break;
    case KeyAction::next_view:
      mode_ = static_cast<ViewMode>((static_cast<int>(mode_) + 1) % 6);
      break;
    case KeyAction::next_flight_mode:
      navigator_->next_mode();
      say(std::string(navigator_->mode_name(language)));
      break;
    case KeyAction::reverse_orbit:
      navigator_->reverse_orbit();
      break;
    case KeyAction::let_go:
      navigator_->let_go();
      break;
    case KeyAction::next_observer:
      observer_.choose_next(frame_.pose, spacetime());
      break;
    default:
      adjust_stereo(action);
      break;
  }
}

void PlayerSession::adjust_stereo(KeyAction action) {
  if (options_.one_eye) {
    return;
  }
  const StereoSettings before = chosen_stereo();
  const StereoSettings after = adjusted(before, action, show_now_.stereo, frame_.pose.r);
  if (action == KeyAction::baseline_reset) {
    // The show's animated values apply again.
    playback_.forget_baseline();
    convergence_.reset();
    stereo_ = show_.stereo;
    return;
  }
  if (after.baseline != before.baseline) {
    apply({TransportCommand::Kind::baseline, after.baseline, {}});
  }
  if (after.convergence != before.convergence) {
    convergence_ = after.convergence;
  }
  stereo_ = after;
}

void PlayerSession::report_replaced_eyes() {
  const bool replaced = eye_count(stereo_) > 1 && stereo_now().model != chosen_stereo().model;
  if (replaced && !reported_replaced_eyes_) {
    say(playback_.language() == "de"
            ? "Das Stereomodell flat ist beim Fall durch den Horizont nicht möglich; verwendet wird physical."
            : "Stereo model flat is not possible in a fall through the horizon; using physical.");
  }
  reported_replaced_eyes_ = replaced;
}

std::vector<KeyAction> PlayerSession::take_requests() { return std::exchange(requests_, {}); }

void PlayerSession::say(std::string message) {
  message_ = std::move(message);
  message_until_s_ = now_s() + message_s;
}

std::string PlayerSession::caption() const {
  std::string text;
  if (flying()) {
    text = fmt::format("{}: {}", navigator_->mode_name(playback_.language()), frame_.observer.sentence);
  } else if (observer_.is_chosen()) {
    text = frame_.observer.sentence;
  }
  if (now_s() < message_until_s_) {
    text += (text.empty() ? "" : "\n") + message_;
  }
  return text;
}

bool PlayerSession::has_words_at(double time_s) const {
  const auto is_there = [&](const auto& word) { return presence_at(word.presence, time_s) > 0.0; };
  const Timeline& timeline = show_.timeline;
  return (playback_.captions() && std::ranges::any_of(timeline.captions, is_there)) ||
         std::ranges::any_of(timeline.overlays, is_there);
}

void PlayerSession::update_frame(double seconds, double shown_time_s) {
  const double time_s = picture_time_s();
  const std::string& language = playback_.language();
  // Off the show's path, a picture need not be rendered again if nothing in the scene changes with
  // time.
  const bool alike = flying() && !changes_by_itself(show_) && !has_words_at(time_s) && !has_words_at(shown_time_s);
  frame_.time_s = alike ? shown_time_s : time_s;
  frame_.pose = navigator_->pose();
  if (!flying()) {
    frame_.path_time_s = time_s;
  }
  observer_.observe(seconds, {show_, spacetime(), time_s, *navigator_, language}, frame_);
  frame_.mode = mode_;
  frame_.field_of_view_deg = field_of_view_deg();
  frame_.stereo = stereo_now();
  frame_.exposure_stops = playback_.exposure_stops();
  frame_.language = language;
  frame_.captions = playback_.captions();
  frame_.light = playback_.light();
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
  if (may_be_within) {
    stereo.model = model_for_fall(stereo.model);
  }
  return stereo;
}

void PlayerSession::end_recording(const Show& scene) {
  recording_.end(scene);
  say(playback_.language() == "de" ? "Die Aufzeichnung endet mit dem Fall durch den Horizont."
                                   : "The recording ends with the fall through the horizon.");
}

Show PlayerSession::scene_now() const {
  Show scene = show_now_;
  scene.stereo = chosen_stereo();
  return scene;
}

std::optional<Show> PlayerSession::recorded(const std::string& title) const {
  return recording_.recorded(scene_now(), title);
}

void PlayerSession::fill(PlayerStatus& status) const {
  playback_.fill(status);
  status.free_flight = flying();
  status.observer = frame_.observer.sentence;
  status.stereo = eye_count(stereo_) > 1;
  status.baseline = stereo_now().baseline;
}

}  // namespace ergodome
