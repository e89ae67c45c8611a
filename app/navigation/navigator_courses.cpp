// Changes of the camera's course: between the show's path and free flight, and between flight
// modes.
#include <array>

#include "app/navigation/navigator.h"
#include "content/fall/rain_pose.h"
#include "kernels/core/error.h"

namespace ergodome {

void Navigator::leave_path() {
  if (course_ == Course::free) {
    return;
  }
  const bool from_path = course_ == Course::path;
  const bool within = from_path && !(path_.r > horizon_radius(spin_));
  if (from_path && settings_.from == FlightStart::path && may_fall_on() &&
      (is_beyond_return(spin_, path_.r) || mode_ == FlightMode::geodesic)) {
    fall_on();
    return;
  }
  if (within || (from_path && settings_.from == FlightStart::first_key)) {
    reset();
    return;
  }
  if (from_path && path_falls_) {
    // From here on the view's axes are boosted from the ZAMO.
    path_ = in_zamo_frame(path_, spin_);
    path_before_ = in_zamo_frame(path_before_, spin_);
    place_ = place_of(path_);
    before_ = place_of(path_before_);
    asked_velocity_ = path_.velocity;
  }
  take_velocity_of(before_, place_, frame_s_, space_);
  course_ = Course::free;
  return_.reset();
  mouse_turn_ = mouse_way_ = glm::dvec3(0.0);
  take_east_from_view();
}

void Navigator::reset() {
  ride_.reset();
  clock_lead_ = path_.clock_lead;
  place_ = before_ = start_;
  course_ = Course::free;
  mode_ = settings_.mode;
  orbit_sense_ = 1.0;
  return_.reset();
  asked_velocity_.reset();
  take_velocity_of(place_, place_, 0.0, space_);
  mouse_turn_ = mouse_way_ = glm::dvec3(0.0);
  take_east_from_view();
}

void Navigator::start_return() {
  const double seconds = frame_s_ > 0.0 ? frame_s_ : 1.0;
  const bool known = frame_s_ > 0.0;
  const CameraPlace camera[2] = {known ? before_ : place_, place_};
  const CameraPose path[2] = {in_zamo_frame(known ? path_before_ : path_, spin_), in_zamo_frame(path_, spin_)};
  return_.emplace(space_, settings_, camera, path, seconds);
}

void Navigator::return_to_path() {
  if (course_ != Course::free) {
    return;
  }
  // A ship can neither leave the horizon nor enter it.
  if (committed() || !(path_.r > horizon_radius(spin_))) {
    reset();
    course_ = Course::path;
    return;
  }
  end_ride();
  start_return();
  asked_velocity_.reset();
  course_ = Course::returning;
}

void Navigator::advance_return(double seconds) {
  place_ = return_->advance(seconds, in_zamo_frame(path_, spin_));
  // The clock converges to the path's within the remaining time of the way.
  const double left_s = std::max(return_->left_s(), 0.0);
  clock_lead_ += (path_.clock_lead - clock_lead_) * (seconds / std::max(left_s + seconds, 1e-9));
  if (return_->arrived()) {
    return_.reset();
    course_ = Course::path;
  }
}

void Navigator::set_mode(FlightMode mode) {
  leave_path();
  if (committed()) {
    return;
  }
  if (mode != mode_) {
    end_ride();  // its velocity becomes the ship's
    take_east_from_view();
  }
  mode_ = mode;
}

void Navigator::next_mode() {
  const bool falls = course_ == Course::path && settings_.from == FlightStart::path && path_falls_ && path_.velocity;
  if (falls && may_fall_on()) {
    fall_on();
    return;
  }
  set_mode(falls ? FlightMode::geodesic : static_cast<FlightMode>((static_cast<int>(mode_) + 1) % 4));
}

void Navigator::reverse_orbit() {
  orbit_sense_ = -orbit_sense_;
  if (committed()) {
    return;
  }
  end_ride();
  asked_velocity_.reset();
}

void Navigator::ride(const Vector3<double>& velocity) {
  if (!(dot(velocity, velocity) < 1.0)) {
    throw Error("orbit", "the speed is not below the speed of light", "choose a speed below 1");
  }
  set_mode(FlightMode::geodesic);
  if (committed()) {
    return;
  }
  end_ride();
  asked_velocity_ = velocity;
}

std::optional<ObserverView> Navigator::own_observer(std::string_view language) const {
  if (course_ != Course::free) {
    return std::nullopt;
  }
  if (ride_) {
    return observer_on_ride(language);
  }
  const CameraPose here = pose();
  if (mode_ == FlightMode::hover) {
    return observer_of(ObserverMotion::fixed, {}, spin_, here.r, here.theta, language);
  }
  return std::nullopt;
}

std::string_view Navigator::mode_name(std::string_view language) const {
  constexpr std::array<std::string_view, 4> english = {"around the hole", "spaceship", "hovering", "free fall"};
  constexpr std::array<std::string_view, 4> german = {"um das Loch", "Raumschiff", "Schweben", "freier Fall"};
  if (course_ != Course::free) {
    const bool back = course_ == Course::returning;
    return language == "de" ? (back ? "zurück zur Vorführung" : "Vorführung") : (back ? "back to the show" : "show");
  }
  return (language == "de" ? german : english)[static_cast<std::size_t>(mode_)];
}

}  // namespace ergodome
