#include "app/navigation/navigator.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/comfort.h"
#include "content/fall/rain_pose.h"
#include "content/fall/within.h"

namespace ergodome {

namespace {

constexpr double longest_frame_s = 0.1;
constexpr double longest_step_s = 1.0 / 240.0;
constexpr glm::dvec3 axis_of_spin(0.0, 0.0, 1.0);
//! Default speed without `faster`, as a fraction of the maximum.
constexpr double usual_part = 0.5;

//! Fractions of the angular acceleration for looking and for going around; the rest is for their
//! coupling.
constexpr double head_part = 0.4;
constexpr double around_part = 0.3;

//! Returns the rate that covers the remaining way and comes to rest at its end.
glm::dvec3 braked(const glm::dvec3& left, double most, double acceleration) {
  constexpr double delay_s = 0.3;
  const double distance = glm::length(left);
  if (!(distance > 0.0)) {
    return glm::dvec3(0.0);
  }
  return left * (std::min({most, distance / delay_s, std::sqrt(1.2 * acceleration * distance)}) / distance);
}

double sane(double value, double most) { return std::isfinite(value) ? std::clamp(value, -most, most) : 0.0; }

Steering sane(const Steering& s, double most) {
  return {sane(s.right, most), sane(s.up, most),   sane(s.forward, most), sane(s.yaw, most),
          sane(s.pitch, most), sane(s.roll, most), sane(s.zoom, most),    std::max(sane(s.faster, 1.0), 0.0)};
}

//! Returns a turn about the view's axes: up, right and clockwise are about x, -y and -z.
glm::dvec3 head_turn(const Steering& s) { return {s.pitch, -s.yaw, -s.roll}; }

bool same(const CameraPose& a, const CameraPose& b) {
  return a.r == b.r && a.theta == b.theta && a.phi == b.phi && a.orientation == b.orientation;
}

//! Returns whether a path jumped between two frames, because of a seek. Checks two azimuths: near
//! the horizon, the Boyer-Lindquist azimuth of infalling cameras changes fast, and the ingoing Kerr
//! azimuth of others.
bool leapt(double spin, const CameraPose& from, const CameraPose& to) {
  const double way = std::min(glm::distance(place_of(from).towards, place_of(to).towards),
                              glm::distance(ingoing_place(from, spin).towards, ingoing_place(to, spin).towards));
  return std::abs(std::log(to.r / from.r)) > 0.5 || way > 0.5;
}

}  // namespace

Navigator::Navigator(const Show& show)
    : spin_(show.spin),
      settings_(show.flight),
      space_(show.spin, show.flight),
      limits_(turn_limits(show.flight.comfort)),
      kept_outside_(kept_outside(show)),
      leads_through_(may_fall_through_horizon(show)),
      start_(place_of(in_zamo_frame(camera_pose(show, show.camera.keys.front().time_s), show.spin))),
      place_(start_),
      mode_(show.flight.mode),
      path_falls_(show.camera.orbit != nullptr),
      path_(camera_pose(show, show.camera.keys.front().time_s)),
      path_before_(path_),
      before_(place_) {
  take_east_from_view();
}

void Navigator::advance(double seconds, const SteeringInput& input, const CameraPose& path) {
  const CameraPose shown = pose();
  clock_lead_ = shown.clock_lead;
  const double frame_s = std::clamp(std::isfinite(seconds) ? seconds : 0.0, 0.0, longest_frame_s);
  if (frame_s > 0.0 || !begun_) {
    const bool jump = !begun_ || leapt(spin_, path_, path);
    path_before_ = jump ? path : path_;
    path_ = path;
    frame_s_ = frame_s;
    begun_ = true;
    if (course_ == Course::returning && !(path_.r > horizon_radius(spin_))) {
      course_ = Course::path;
      return_.reset();
    } else if (jump && course_ == Course::returning) {
      start_return();
    }
  }
  const CameraPlace from = place_;
  const Vector3<double> velocity_from = ride_ ? ride_->velocity() : Vector3<double>{};
  switch (course_) {
    case Course::path:
      place_ = place_of(path_);
      before_ = place_of(path_before_);
      break;
    case Course::returning:
      advance_return(frame_s);
      before_ = from;
      break;
    case Course::free: {
      const Steering amounts = sane(input.amounts, 10.0);
      mouse_turn_ = shortened(mouse_turn_ + head_turn(amounts), 3.2);
      mouse_way_ = shortened(mouse_way_ + glm::dvec3(amounts.right, amounts.up, amounts.forward), 2.0);
      const Steering rates = sane(input.rates, 1.0);
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

void Navigator::set_spin(double spin) {
  if (spin == spin_) {
    return;
  }
  spin_ = spin;
  space_ = FlightSpace(spin, settings_);
  if (course_ != Course::path && !falls_through()) {
    place_.r = std::max(place_.r, space_.guard_r());
  }
}

glm::dvec3 Navigator::from_mouse(glm::dvec3& pending, double most, double seconds) const {
  constexpr double delay_s = 0.06;
  const glm::dvec3 rate = shortened(pending / delay_s, most);
  pending -= rate * std::min(seconds, delay_s);
  return rate;
}

Navigator::Wish Navigator::wish(const Steering& s, double seconds) {
  Wish wish;
  wish.hurry = s.faster;
  const double speed = usual_part + (1.0 - usual_part) * s.faster;
  wish.head = limits_.head * shortened(head_turn(s), 1.0);
  if (glm::length(wish.head) > 0.0) {
    mouse_turn_ = glm::dvec3(0.0);
  } else {
    wish.head = braked(mouse_turn_, limits_.head, head_part * limits_.acceleration);
  }
  const glm::dvec3 way = shortened(settings_.max_speed * speed * shortened({s.right, s.up, s.forward}, 1.0) +
                                       from_mouse(mouse_way_, settings_.max_speed, seconds),
                                   settings_.max_speed) /
                         settings_.max_speed;
  if (mode_ == FlightMode::fly) {
    wish.fly = settings_.max_speed * (place_.view * glm::dvec3(way.x, way.y, -way.z));
  } else if (mode_ == FlightMode::orbit) {
    // Near the axis, a step to the east is only a rotation. It fades out, and becomes a step to the
    // west on the other side.
    constexpr double near_axis = 0.15;
    const double sine = glm::dot(place_.towards, glm::cross(east_, axis_of_spin));
    const double eastward = sine / std::hypot(sine, near_axis);
    wish.around = {limits_.around * way.x * eastward, limits_.around * way.y, -settings_.max_speed * way.z};
  }
  return wish;
}

void Navigator::follow_wish(const Wish& wish, double seconds) {
  const double turn_change = limits_.acceleration * seconds;
  follow(head_, wish.head, seconds, head_part * turn_change);
  if (glm::length(mouse_turn_) > 0.0) {
    mouse_turn_ -= seconds * head_;
    const bool there = glm::length(mouse_turn_) < 1e-4 && glm::length(head_) < 1e-3;
    mouse_turn_ = there ? glm::dvec3(0.0) : mouse_turn_;
  }
  // The two angles and the radial motion have separate limits.
  glm::dvec3 angles(around_.x, around_.y, 0.0);
  follow(angles, {wish.around.x, wish.around.y, 0.0}, seconds, around_part * turn_change);
  glm::dvec3 outward(0.0, 0.0, around_.z);
  const double most = settings_.comfort.accel * seconds;
  const double used = follow(outward, {0.0, 0.0, wish.around.z}, seconds, most);
  around_ = {angles.x, angles.y, outward.z};
  follow(fly_, wish.fly, seconds, most - used);
}

void Navigator::step(const Steering& steering, double seconds) {
  const Wish wanted = wish(steering, seconds);
  follow_wish(wanted, seconds);
  glm::dvec3 turn = place_.view * head_;
  if (mode_ != FlightMode::geodesic) {
    asked_velocity_.reset();
  } else if (!ride_) {
    begin_ride();
  }
  if (ride_) {
    move_on_orbit(wanted.hurry, seconds, turn);
  } else {
    move_around(seconds, turn);
    space_.move(place_, fly_, seconds);
    level_east();
  }
  turn_view(turn, seconds);
}

void Navigator::move_around(double seconds, glm::dvec3& turn) {
  const glm::dvec3 axis = around_.x * axis_of_spin - around_.y * east_;
  const glm::dquat turned = rotation(seconds * axis);
  place_.towards = glm::normalize(turned * place_.towards);
  east_ = rotation(seconds * around_.x * axis_of_spin) * east_;
  turn += axis;
  place_.r = space_.moved_radius(place_.r, around_.z * space_.distance(place_.r), seconds);
}

void Navigator::move_on_orbit(double hurry, double seconds, glm::dvec3& turn) {
  const CameraPlace before = place_;
  ride_->advance(seconds, hurry, place_);
  turn += turn_of(shortest_rotation(before.towards, place_.towards)) / seconds;
  level_east();
  const glm::dvec3 way = (place_.towards - before.towards) / seconds;
  fly_ = shortened(ride_->space().velocity(before, (place_.r - before.r) / seconds, way), settings_.max_speed);
}

//! Turns the view within the limits of comfort.
void Navigator::turn_view(const glm::dvec3& wanted, double seconds) {
  const glm::dvec3 missing = shortened(wanted, limits_.total) - turn_;
  turn_ += shortened(missing, limits_.acceleration * seconds);
  place_.view = glm::normalize(rotation(seconds * turn_) * place_.view);
}

//! Makes `east_` horizontal and perpendicular to the direction to the camera.
void Navigator::level_east() {
  const glm::dvec3 east = glm::cross(axis_of_spin, place_.towards);
  const double sine = glm::length(east);
  if (sine > 1e-9) {
    east_ = (glm::dot(east, east_) < 0.0 ? -1.0 : 1.0) * east / sine;
  }
}

//! Sets `east_` so that east is to the right, or north is up, in the view of the hole.
void Navigator::take_east_from_view() {
  east_ = east_at(place_.towards);
  const double upright = glm::dot(place_.view * glm::dvec3(0.0, 1.0, 0.0), glm::cross(place_.towards, east_));
  const double right = glm::dot(place_.view * glm::dvec3(1.0, 0.0, 0.0), east_);
  if ((std::abs(upright) > 0.1 ? upright : right) < 0.0) {
    east_ = -east_;
  }
}

bool Navigator::coasting() const { return !at_rest(around_) || !at_rest(fly_); }

void Navigator::take_velocity_of(const CameraPlace& before, const CameraPlace& now, double seconds,
                                 const FlightSpace& space) {
  head_ = glm::dvec3(0.0);
  around_ = glm::dvec3(0.0);
  fly_ = glm::dvec3(0.0);
  turn_ = glm::dvec3(0.0);
  if (seconds > 0.0) {
    const glm::dvec3 way = (now.towards - before.towards) / seconds;
    fly_ = shortened(space.velocity(now, (now.r - before.r) / seconds, way), settings_.max_speed);
    turn_ = shortened(turn_of(now.view * glm::conjugate(before.view)) / seconds, limits_.total);
  }
}

}  // namespace ergodome
