#include "app/navigation/navigator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/navigation/comfort.h"
#include "content/camera/rain_pose.h"
#include "content/camera/within.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr double longest_frame_s = 0.1;
constexpr double longest_step_s = 1.0 / 240.0;
constexpr glm::dvec3 axis_of_spin(0.0, 0.0, 1.0);

bool same(const CameraPose& a, const CameraPose& b) {
  return a.r == b.r && a.theta == b.theta && a.phi == b.phi && a.orientation == b.orientation;
}

//! Returns whether a path jumped between two frames, because of a seek. Compares both the
//! Boyer-Lindquist and the ingoing Kerr azimuths, and uses the smaller change: near the horizon,
//! the former changes fast for infalling cameras, the latter for others.
bool leapt(Spacetime spacetime, const CameraPose& from, const CameraPose& to) {
  const double way =
      std::min(glm::distance(placement_of(from).towards, placement_of(to).towards),
               glm::distance(ingoing_placement(from, spacetime).towards, ingoing_placement(to, spacetime).towards));
  return std::abs(std::log(to.r / from.r)) > 0.5 || way > 0.5;
}

}  // namespace

Navigator::Navigator(const Show& show)
    : spacetime_(spacetime_of(show)),
      settings_(show.flight),
      space_(spacetime_, show.flight),
      motion_(show.flight),
      kept_outside_(kept_outside(show)),
      leads_through_(may_fall_through_horizon(show)),
      start_(placement_of(in_zamo_frame(camera_pose(show, show.camera.keys.front().time_s), spacetime_of(show)))),
      placement_(start_),
      mode_(show.flight.mode),
      path_falls_(show.camera.orbit != nullptr),
      path_(camera_pose(show, show.camera.keys.front().time_s)),
      path_before_(path_),
      before_(placement_) {
  take_east_from_view();
}

void Navigator::advance(double seconds, const SteeringInput& input, const CameraPose& path) {
  const CameraPose shown = pose();
  clock_lead_ = shown.clock_lead;
  const double frame_s = std::clamp(std::isfinite(seconds) ? seconds : 0.0, 0.0, longest_frame_s);
  if (frame_s > 0.0 || !begun_) {
    const bool jump = !begun_ || leapt(spacetime_, path_, path);
    path_before_ = jump ? path : path_;
    path_ = path;
    frame_s_ = frame_s;
    begun_ = true;
    if (course_ == Course::returning && !(path_.r > horizon_radius(spacetime_))) {
      course_ = Course::path;
      return_.reset();
    } else if (jump && course_ == Course::returning) {
      start_return();
    }
  }
  const CameraPlacement from = placement_;
  const Vector3<double> velocity_from = ride_ ? ride_->velocity() : Vector3<double>{};
  switch (course_) {
    case Course::path:
      placement_ = placement_of(path_);
      before_ = placement_of(path_before_);
      break;
    case Course::returning:
      advance_return(frame_s);
      before_ = from;
      break;
    case Course::free: {
      motion_.add_mouse(limited_steering(input.amounts, 10.0));
      const Steering rates = limited_steering(input.rates, 1.0);
      const bool fell_through = falls_through();
      const int steps = std::max(1, static_cast<int>(std::ceil(frame_s / longest_step_s)));
      for (int i = 0; i < steps && frame_s > 0.0; ++i) {
        step(rates, frame_s / steps);
      }
      if (falls_through() == fell_through) {
        before_ = from;
        ride_before_ = velocity_from;
      }
      break;
    }
  }
  moved_ = !same(shown, pose());
}

void Navigator::set_spacetime(Spacetime spacetime) {
  if (spacetime == spacetime_) {
    return;
  }
  spacetime_ = spacetime;
  space_ = FlightSpace(spacetime, settings_);
  if (course_ != Course::path && !falls_through()) {
    placement_.r = std::max(placement_.r, space_.guard_r());
  }
}

void Navigator::look(const glm::dquat& orientation) {
  if (course_ != Course::free) {
    return;
  }
  CameraPose here = pose_of(placement_);
  here.orientation = key_orientation(CameraKey()) * orientation;
  placement_.view = placement_of(here).view;
  turn_ = glm::dvec3(0.0);
}

void Navigator::step(const Steering& steering, double seconds) {
  // `east_` keeps its sign where the camera crosses the spin axis. So near the axis, the motion
  // around it that a step to the east causes fades out, and continues in the other direction
  // beyond.
  constexpr double near_axis = 0.15;
  const double sine = glm::dot(placement_.towards, glm::cross(east_, axis_of_spin));
  motion_.follow_steering(steering, mode_, placement_.view, sine / std::hypot(sine, near_axis), seconds);
  glm::dvec3 turn = placement_.view * motion_.head();
  if (mode_ != FlightMode::geodesic) {
    asked_velocity_.reset();
  } else if (!ride_) {
    begin_ride();
  }
  if (ride_) {
    move_on_orbit(steering.faster, seconds, turn);
  } else {
    move_around(seconds, turn);
    space_.move(placement_, motion_.fly(), seconds);
    level_east();
  }
  turn_view(turn, seconds);
}

void Navigator::move_around(double seconds, glm::dvec3& turn) {
  const glm::dvec3& around = motion_.around();
  const glm::dvec3 axis = around.x * axis_of_spin - around.y * east_;
  const glm::dquat turned = rotation(seconds * axis);
  placement_.towards = glm::normalize(turned * placement_.towards);
  east_ = rotation(seconds * around.x * axis_of_spin) * east_;
  turn += axis;
  placement_.r = space_.moved_radius(placement_.r, around.z * space_.distance(placement_.r), seconds);
}

void Navigator::move_on_orbit(double hurry, double seconds, glm::dvec3& turn) {
  const CameraPlacement before = placement_;
  ride_->advance(seconds, hurry, placement_);
  turn += turn_of(shortest_rotation(before.towards, placement_.towards)) / seconds;
  level_east();
  const glm::dvec3 way = (placement_.towards - before.towards) / seconds;
  motion_.set_fly(
      shortened(ride_->space().velocity(before, (placement_.r - before.r) / seconds, way), settings_.max_speed));
}

//! Turns the view for a step at the wanted rate [rad/s], as far as the limits of comfort allow.
void Navigator::turn_view(const glm::dvec3& wanted, double seconds) {
  const glm::dvec3 missing = shortened(wanted, motion_.limits().total) - turn_;
  turn_ += shortened(missing, motion_.limits().acceleration * seconds);
  placement_.view = glm::normalize(rotation(seconds * turn_) * placement_.view);
}

//! Makes `east_` perpendicular to the spin axis and to the direction to the camera; keeps its sign.
void Navigator::level_east() {
  const glm::dvec3 east = glm::cross(axis_of_spin, placement_.towards);
  const double sine = glm::length(east);
  if (sine > 1e-9) {
    east_ = (glm::dot(east, east_) < 0.0 ? -1.0 : 1.0) * east / sine;
  }
}

//! Sets `east_` so that north is up in the view; if north is neither clearly up nor down, so that
//! east is to the right.
void Navigator::take_east_from_view() {
  east_ = east_at(placement_.towards);
  const double upright = glm::dot(placement_.view * glm::dvec3(0.0, 1.0, 0.0), glm::cross(placement_.towards, east_));
  const double right = glm::dot(placement_.view * glm::dvec3(1.0, 0.0, 0.0), east_);
  if ((std::abs(upright) > 0.1 ? upright : right) < 0.0) {
    east_ = -east_;
  }
}

void Navigator::take_velocity_of(const CameraPlacement& before, const CameraPlacement& now, double seconds,
                                 const FlightSpace& space) {
  glm::dvec3 fly(0.0);
  turn_ = glm::dvec3(0.0);
  if (seconds > 0.0) {
    const glm::dvec3 way = (now.towards - before.towards) / seconds;
    fly = shortened(space.velocity(now, (now.r - before.r) / seconds, way), settings_.max_speed);
    turn_ = shortened(turn_of(now.view * glm::conjugate(before.view)) / seconds, motion_.limits().total);
  }
  motion_.move_as_ship(fly);
}

void Navigator::leave_path() {
  if (course_ == Course::free) {
    return;
  }
  const bool from_path = course_ == Course::path;
  const bool within = from_path && !(path_.r > horizon_radius(spacetime_));
  if (from_path && settings_.from == FlightStart::path && may_fall_on() &&
      (is_beyond_return(spacetime_, path_.r) || mode_ == FlightMode::geodesic)) {
    fall_on();
    return;
  }
  if (within || (from_path && settings_.from == FlightStart::first_key)) {
    reset();
    return;
  }
  if (from_path && path_falls_) {
    // Off the path, the axes of the view are boosted from those of the ZAMO, not from the rain
    // frame.
    path_ = in_zamo_frame(path_, spacetime_);
    path_before_ = in_zamo_frame(path_before_, spacetime_);
    placement_ = placement_of(path_);
    before_ = placement_of(path_before_);
    asked_velocity_ = path_.velocity;
  }
  take_velocity_of(before_, placement_, frame_s_, space_);
  course_ = Course::free;
  return_.reset();
  motion_.forget_mouse();
  take_east_from_view();
}

void Navigator::reset() {
  ride_.reset();
  clock_lead_ = path_.clock_lead;
  placement_ = before_ = start_;
  course_ = Course::free;
  mode_ = settings_.mode;
  orbit_sense_ = 1.0;
  return_.reset();
  asked_velocity_.reset();
  take_velocity_of(placement_, placement_, 0.0, space_);
  motion_.forget_mouse();
  take_east_from_view();
}

void Navigator::start_return() {
  const double seconds = frame_s_ > 0.0 ? frame_s_ : 1.0;
  const bool known = frame_s_ > 0.0;
  const CameraPlacement camera[2] = {known ? before_ : placement_, placement_};
  const CameraPose path[2] = {in_zamo_frame(known ? path_before_ : path_, spacetime_),
                              in_zamo_frame(path_, spacetime_)};
  return_.emplace(space_, settings_, camera, path, seconds);
}

void Navigator::return_to_path() {
  if (course_ != Course::free) {
    return;
  }
  // The camera cannot fly back to the path across the horizon, in either direction, so it jumps to
  // the path instead.
  if (committed() || !(path_.r > horizon_radius(spacetime_))) {
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
  placement_ = return_->advance(seconds, in_zamo_frame(path_, spacetime_));
  // `clock_lead_` converges to that of the path within the time that the return still takes.
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
    end_ride();  // the ride's velocity becomes that of the ship
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

std::optional<ObserverView> Navigator::flight_observer(std::string_view language) const {
  if (course_ != Course::free) {
    return std::nullopt;
  }
  if (ride_) {
    return observer_on_ride(language);
  }
  const CameraPose here = pose();
  if (mode_ == FlightMode::hover) {
    return observer_of(ObserverMotion::fixed, {}, spacetime_, here.r, here.theta, language);
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

bool Navigator::committed() const {
  return course_ == Course::free && falls_through() && is_beyond_return(spacetime_, placement_.r);
}

CameraPose Navigator::pose() const {
  if (course_ == Course::path) {
    return path_;
  }
  if (!falls_through()) {
    CameraPose pose = pose_of(placement_);
    pose.clock_lead = clock_lead_;
    return pose;
  }
  CameraPose pose = pose_of_ingoing(placement_, spacetime_);
  pose.velocity = ride_->velocity();
  pose.velocity_in_rain = true;
  pose.clock_lead = outer_lag(spacetime_, pose.r) + lead_over_lag_;
  return pose;
}

//! Returns the rotation rate of the ingoing Kerr azimuth relative to the Boyer-Lindquist azimuth
//! during a ride outside the horizon, as a vector along the spin axis [rad/s].
glm::dvec3 Navigator::turn_of_azimuth() const {
  const KerrFunctions f = kerr_functions(spacetime_, placement_.r, 0.0);
  return {0.0, 0.0, spacetime_.spin / f.delta * ride_->radial_speed()};
}

//! Starts a ride with the requested velocity, otherwise on a circular orbit. While the camera still
//! moves, starts only a requested orbit along which it moves already. An infalling orbit leads
//! through the horizon if the show allows that.
void Navigator::begin_ride() {
  if (motion_.coasts() && !(asked_velocity_ && at_rest(motion_.around()))) {
    return;
  }
  const CameraPose here = pose_of(placement_);
  const Vector3<double> velocity =
      asked_velocity_.value_or(circular_velocity(spacetime_, here.r, here.theta, orbit_sense_));
  OrbitRide ride(space_, settings_, placement_, velocity);
  if (!ride.take_over(placement_, motion_.fly()) && motion_.coasts()) {
    return;
  }
  ride_ = ride;
  asked_velocity_.reset();
  if (leads_through_ && ride.falls_into_hole()) {
    CameraPose falls = here;
    falls.velocity = velocity;
    falls = in_rain_frame(falls, spacetime_);
    ride_ = OrbitRide::through_horizon(spacetime_, settings_, falls);
    ride_->take_clock_of(ride);
    lead_over_lag_ = clock_lead_ - outer_lag(spacetime_, falls.r);
    placement_ = before_ = ingoing_placement(falls, spacetime_);
    ride_before_ = ride_->velocity();
    turn_ += turn_of_azimuth();
    take_east_from_view();
  }
}

//! Ends a ride. After one through the horizon, converts the camera, which must be outside, to
//! Boyer-Lindquist azimuths and the axes of the ZAMO.
void Navigator::end_ride() {
  if (falls_through()) {
    CameraPose before = pose_of_ingoing(before_, spacetime_);
    before.velocity = ride_before_;
    before.velocity_in_rain = true;
    placement_ = placement_of(in_zamo_frame(pose(), spacetime_));
    before_ = placement_of(in_zamo_frame(before, spacetime_));
    take_velocity_of(before_, placement_, frame_s_, space_);
    take_east_from_view();
  }
  ride_.reset();
}

//! Returns whether the path is in free fall that a visitor may continue through the horizon: the
//! show allows it, and the path is inside the horizon or its orbit leads into the hole.
bool Navigator::may_fall_on() const {
  if (!leads_through_ || !path_falls_ || !path_.velocity || !path_.velocity_in_rain) {
    return false;
  }
  return !(path_.r > horizon_radius(spacetime_)) ||
         OrbitRide::through_horizon(spacetime_, settings_, path_).falls_into_hole();
}

//! Leaves the path, outside or inside the horizon, and continues along the orbit of its fall, with
//! a clock rate at which the camera keeps its velocity.
void Navigator::fall_on() {
  placement_ = ingoing_placement(path_, spacetime_);
  before_ = ingoing_placement(in_rain_frame(path_before_, spacetime_), spacetime_);
  ride_ = OrbitRide::through_horizon(spacetime_, settings_, path_);
  ride_before_ = ride_->velocity();
  lead_over_lag_ = path_.clock_lead - outer_lag(spacetime_, path_.r);
  take_velocity_of(before_, placement_, frame_s_, ride_->space());
  ride_->match_motion(placement_, motion_.fly());
  course_ = Course::free;
  mode_ = FlightMode::geodesic;
  return_.reset();
  asked_velocity_.reset();
  motion_.forget_mouse();
  take_east_from_view();
}

void Navigator::let_go() {
  if (course_ == Course::path && settings_.from == FlightStart::path && may_fall_on()) {
    fall_on();
  } else if (!(course_ == Course::free && falls_through())) {
    ride({0.0, 0.0, 0.0});
  }
}

ObserverView Navigator::observer_on_ride(std::string_view language) const {
  const CameraPose here = pose();
  const bool german = language == "de";
  if (falls_through()) {
    const Vector3<double> velocity = in_zamo_frame(here, spacetime_).velocity.value_or(Vector3<double>{});
    ObserverView view = falling_into_hole(here.r, spacetime_, velocity, ride_->left(), language);
    if (ride_->held() && !(here.r > horizon_radius(spacetime_))) {
      view.sentence += german ? " (tiefer geht es nicht: die Zeit ist angehalten)"
                              : " (no deeper fall is possible: time is stopped)";
    }
    return view;
  }
  ObserverView view =
      observer_of(ObserverMotion::velocity, ride_->velocity(), spacetime_, here.r, here.theta, language);
  view.name = german ? "auf freier Umlaufbahn" : "in free orbit";
  view.sentence = view.name + view.sentence.substr(view.sentence.rfind(','));
  // At radii below this many times the guard's, the observer's description includes where the fall
  // ends.
  constexpr double near = 2.0;
  if (kept_outside_ && here.r < near * space_.guard_r() && ride_->falls_into_hole()) {
    view.sentence +=
        " (" + text_in(*kept_outside_, language) + (german ? ": der Fall endet davor)" : ": the fall ends outside it)");
  } else if (ride_->held()) {
    view.sentence += german ? " (sie verlässt das Fluggebiet: die Zeit ist angehalten)"
                            : " (the orbit leaves the flight region: time is stopped)";
  }
  return view;
}

}  // namespace ergodome
