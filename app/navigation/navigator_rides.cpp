// How falls begin and end, and what the screen says about them.
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

//! How fast directions of ingoing azimuths turn against those of Boyer-Lindquist's on a ride outside the horizon [rad/s].
glm::dvec3 Navigator::turn_of_azimuth() const {
  const KerrFunctions f = kerr_functions(spin_, place_.r, 0.0);
  return {0.0, 0.0, spin_ / f.delta * ride_->radial_speed()};
}

//! A ride begins at rest, or as the camera goes already. Where its orbit falls into the hole, it leads through the horizon if it may.
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

//! A ride through the horizon that ends outside of it leaves the camera to directions and axes as other flights have them.
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

//! Whether the path falls along an orbit that a visitor may go on along through the horizon.
bool Navigator::may_fall_on() const {
  if (!leads_through_ || !path_falls_ || !path_.velocity || !path_.velocity_in_rain) {
    return false;
  }
  return !(path_.r > horizon_radius(spin_)) || OrbitRide::through_horizon(spin_, settings_, path_).falls_into_hole();
}

//! Goes on along the orbit of a path that falls through the horizon, as fast as the path does, on either side of the horizon.
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
  constexpr double near = 2.0;  // so many radii of the guard away who falls is told where that ends
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
