// Begin and end of falls, and their descriptions on the screen.
#include "app/navigation/comfort.h"
#include "app/navigation/navigator.h"
#include "content/fall/rain_pose.h"

namespace ergodome {

bool Navigator::committed() const {
  return course_ == Course::free && falls_through() && is_beyond_return(spin_, place_.r);
}

CameraPose Navigator::pose() const {
  if (course_ == Course::path) {
    return path_;
  }
  if (!falls_through()) {
    CameraPose pose = pose_of(place_);
    pose.clock_lead = clock_lead_;
    return pose;
  }
  CameraPose pose = pose_of_ingoing(place_, spin_);
  pose.velocity = ride_->velocity();
  pose.velocity_in_rain = true;
  pose.clock_lead = outer_lag(spin_, pose.r) + lead_over_lag_;
  return pose;
}

//! Returns how fast ingoing azimuths rotate relative to Boyer-Lindquist azimuths during a ride
//! outside the horizon [rad/s].
glm::dvec3 Navigator::turn_of_azimuth() const {
  const KerrFunctions f = kerr_functions(spin_, place_.r, 0.0);
  return {0.0, 0.0, spin_ / f.delta * ride_->radial_speed()};
}

//! Starts a ride from rest, or at the camera's velocity. An infalling orbit leads through the
//! horizon if allowed.
void Navigator::begin_ride() {
  if (coasting() && !(asked_velocity_ && at_rest(around_))) {
    return;
  }
  const CameraPose here = pose_of(place_);
  const Vector3<double> velocity = asked_velocity_.value_or(circular_velocity(spin_, here.r, here.theta, orbit_sense_));
  OrbitRide ride(space_, settings_, place_, velocity);
  if (!ride.take_over(place_, fly_) && coasting()) {
    return;
  }
  ride_ = ride;
  asked_velocity_.reset();
  if (leads_through_ && ride.falls_into_hole()) {
    CameraPose falls = here;
    falls.velocity = velocity;
    falls = in_rain_frame(falls, spin_);
    ride_ = OrbitRide::through_horizon(spin_, settings_, falls);
    ride_->take_clock_of(ride);
    lead_over_lag_ = clock_lead_ - outer_lag(spin_, falls.r);
    place_ = before_ = ingoing_place(falls, spin_);
    ride_before_ = ride_->velocity();
    turn_ += turn_of_azimuth();
    take_east_from_view();
  }
}

//! Ends a ride. One through the horizon that ends outside converts the camera to the azimuths and
//! axes of other flights.
void Navigator::end_ride() {
  if (falls_through()) {
    CameraPose before = pose_of_ingoing(before_, spin_);
    before.velocity = ride_before_;
    before.velocity_in_rain = true;
    place_ = place_of(in_zamo_frame(pose(), spin_));
    before_ = place_of(in_zamo_frame(before, spin_));
    take_velocity_of(before_, place_, frame_s_, space_);
    take_east_from_view();
  }
  ride_.reset();
}

//! Returns whether the path falls along an orbit that a visitor may continue through the horizon.
bool Navigator::may_fall_on() const {
  if (!leads_through_ || !path_falls_ || !path_.velocity || !path_.velocity_in_rain) {
    return false;
  }
  return !(path_.r > horizon_radius(spin_)) || OrbitRide::through_horizon(spin_, settings_, path_).falls_into_hole();
}

//! Continues along the orbit of a path that falls through the horizon, as fast as the path, inside
//! or outside.
void Navigator::fall_on() {
  place_ = ingoing_place(path_, spin_);
  before_ = ingoing_place(in_rain_frame(path_before_, spin_), spin_);
  ride_ = OrbitRide::through_horizon(spin_, settings_, path_);
  ride_before_ = ride_->velocity();
  lead_over_lag_ = path_.clock_lead - outer_lag(spin_, path_.r);
  take_velocity_of(before_, place_, frame_s_, ride_->space());
  ride_->go_as(place_, fly_);
  course_ = Course::free;
  mode_ = FlightMode::geodesic;
  return_.reset();
  asked_velocity_.reset();
  mouse_turn_ = mouse_way_ = glm::dvec3(0.0);
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
    const Vector3<double> velocity = in_zamo_frame(here, spin_).velocity.value_or(Vector3<double>{});
    ObserverView view = falling_into_hole(here.r, spin_, velocity, ride_->left(), language);
    if (ride_->held() && !(here.r > horizon_radius(spin_))) {
      view.sentence += german ? " (tiefer geht es nicht: die Zeit ist angehalten)"
                              : " (no deeper fall is possible: time is stopped)";
    }
    return view;
  }
  ObserverView view = observer_of(ObserverMotion::velocity, ride_->velocity(), spin_, here.r, here.theta, language);
  view.name = german ? "auf freier Umlaufbahn" : "in free orbit";
  view.sentence = view.name + view.sentence.substr(view.sentence.rfind(','));
  // Within so many guard radii, the observer's description includes where the fall ends.
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
