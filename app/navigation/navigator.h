#pragma once

#include <optional>
#include <string_view>

#include "app/navigation/camera_place.h"
#include "app/navigation/controls/steering.h"
#include "app/navigation/flight_space.h"
#include "app/navigation/observer_mode.h"
#include "app/navigation/orbit_ride.h"
#include "app/navigation/path_return.h"
#include "app/navigation/turn_limits.h"
#include "content/show/show.h"

namespace ergodome {

//! All that a person asks for in a frame.
struct SteeringInput {
  Steering rates;    //!< keys, sticks: for as long as they are held
  Steering amounts;  //!< a mouse: turns in radians, ways in distances, zoom in steps
};

//! A camera that follows a show's path or that a visitor flies, within the show's limits and those of comfort. No window, no clock.
class Navigator {
 public:
  //! Where the camera is going.
  enum class Course { path, returning, free };

  explicit Navigator(const Show& show);

  //! Goes on by the time since the last frame; at most a tenth of a second of it counts, so that a camera does not leap after a frame that
  //! hung. `path` is where the show's path has its camera now. Any input is taken: rates beyond ±1 as that, what is no number as none.
  void advance(double seconds, const SteeringInput& input, const CameraPose& path);

  //! The hole's spin, where the show changes it. A ride goes on around the hole that it began at.
  void set_spin(double spin);

  //! Takes the camera off the path, with the velocity it has, in free fall along the orbit of a path that falls, within the horizon too; or from
  //! the show's first key, if the show says so.
  void leave_path();
  //! Flies back to the path, and follows it from there; at once where one of both is within the horizon. On the path: nothing.
  void return_to_path();
  //! Free flight, at rest, from where it first began.
  void reset();

  void set_mode(FlightMode mode);
  //! The next way to fly; takes the camera off the path. From a path that falls the first is to fall on.
  void next_mode();
  //! Circular orbits are to run the other way from now on; a ride begins anew.
  void reverse_orbit();
  //! Falls freely from here on, from a velocity in the ZAMO frame slower than light. Throws Error for another.
  void ride(const Vector3<double>& velocity);
  //! Falls freely from rest, carried along by space alone: into the hole. A camera that falls into it already goes on.
  void let_go();

  //! Has a velocity where the camera falls through the horizon.
  [[nodiscard]] CameraPose pose() const;
  //! The camera's own time since it began to fall through the horizon, or was taken from a path that does [M]; nothing where it does not fall so.
  [[nodiscard]] std::optional<double> own_time() const {
    return course_ != Course::path && falls_through() ? std::optional(ride_->own_time()) : std::nullopt;
  }
  [[nodiscard]] Course course() const { return course_; }
  [[nodiscard]] FlightMode mode() const { return mode_; }
  //! Whether the last `advance` changed the pose.
  [[nodiscard]] bool moved() const { return moved_; }

  //! How the camera itself moves, where that decides who looks: on an orbit, or hovering in free flight.
  [[nodiscard]] std::optional<ObserverView> own_observer(std::string_view language = "en") const;

  //! Whether the camera, off its path, is where nothing leads out again: within the horizon, or all but there. Only `reset` and
  //! `return_to_path` have it elsewhere then.
  [[nodiscard]] bool committed() const;

  //! The way of flying, for the screen.
  [[nodiscard]] std::string_view mode_name(std::string_view language = "en") const;

  //! Turn of the view about directions that do not turn [rad/s], and the velocity of a ship [distances/s]: what comfort limits.
  [[nodiscard]] const glm::dvec3& turn_rate() const { return turn_; }
  [[nodiscard]] const glm::dvec3& fly_velocity() const { return fly_; }
  [[nodiscard]] const FlightSpace& space() const { return space_; }

 private:
  //! What is asked for in a step.
  struct Wish {
    glm::dvec3 head{0.0};    //!< about the view's axes [rad/s]
    glm::dvec3 around{0.0};  //!< to the east and to the north as the camera has them [rad/s], outwards [distances/s]
    glm::dvec3 fly{0.0};     //!< [distances/s]
    double hurry = 0.0;
  };
  [[nodiscard]] Wish wish(const Steering& steering, double seconds);
  //! Takes what a mouse still has to give: what the limits leave for a step.
  glm::dvec3 from_mouse(glm::dvec3& pending, double most, double seconds) const;
  void step(const Steering& steering, double seconds);
  void begin_ride();
  void end_ride();
  void fall_on();
  [[nodiscard]] bool falls_through() const { return ride_ && ride_->leads_through_horizon(); }
  [[nodiscard]] bool may_fall_on() const;
  [[nodiscard]] glm::dvec3 turn_of_azimuth() const;
  [[nodiscard]] ObserverView observer_on_ride(std::string_view language) const;
  void follow_wish(const Wish& wish, double seconds);
  void move_around(double seconds, glm::dvec3& turn);
  void move_on_orbit(double hurry, double seconds, glm::dvec3& turn);
  void turn_view(const glm::dvec3& wanted, double seconds);
  void level_east();
  void take_east_from_view();
  void take_velocity_of(const CameraPlace& before, const CameraPlace& now, double seconds, const FlightSpace& space);
  void advance_return(double seconds);
  void start_return();
  [[nodiscard]] bool coasting() const;

  double spin_;
  FlightSettings settings_;
  FlightSpace space_;
  TurnLimits limits_;
  std::optional<LocalText> kept_outside_;  //!< why visitors do not fall through the horizon, where the show says so
  bool leads_through_;                     //!< whether orbits that fall into the hole lead through the horizon
  CameraPlace start_;
  CameraPlace place_;
  Course course_ = Course::path;
  FlightMode mode_;
  bool path_falls_;
  double orbit_sense_ = 1.0;
  CameraPose path_;         //!< of the last frame
  CameraPose path_before_;  //!< of the one before
  CameraPlace before_;
  double frame_s_ = 0.0;  //!< between the two
  bool begun_ = false;
  bool moved_ = true;
  glm::dvec3 head_{0.0};  //!< rates, as in Wish
  glm::dvec3 around_{0.0};
  glm::dvec3 fly_{0.0};
  glm::dvec3 turn_{0.0};
  glm::dvec3 east_{0.0, 1.0, 0.0};  //!< level and across `towards`; not turned round by the axis
  glm::dvec3 mouse_turn_{0.0};      //!< pitch, yaw, roll still to be turned [rad]
  glm::dvec3 mouse_way_{0.0};       //!< right, up, forward still to be gone [distances]
  std::optional<OrbitRide> ride_;   //!< through the horizon: `place_` and `before_` are in ingoing azimuths then
  Vector3<double> ride_before_{};   //!< its velocity at `before_`
  double clock_lead_ = 0.0;         //!< the pose's, that is kept where nobody falls through the horizon [M]
  double lead_over_lag_ = 0.0;      //!< and by how much more than outer_lag() it is where somebody does [M]
  std::optional<Vector3<double>> asked_velocity_;
  std::optional<PathReturn> return_;
};

}  // namespace ergodome
