#pragma once

#include <optional>
#include <string_view>

#include "app/navigation/camera_placement.h"
#include "app/navigation/controls/steering.h"
#include "app/navigation/flight_space.h"
#include "app/navigation/observer_mode.h"
#include "app/navigation/orbit_ride.h"
#include "app/navigation/path_return.h"
#include "app/navigation/steered_motion.h"
#include "content/show/show.h"

namespace ergodome {

//! A camera that follows a show's path or is flown by a visitor, within the limits of the show and
//! of comfort. Uses no window and reads no clock.
class Navigator {
 public:
  //! Whether the camera is on the show's path, on its way back to it, or in free flight.
  enum class Course { path, returning, free };

  explicit Navigator(const Show& show);

  //! Advances by the time since the last frame, limited to a tenth of a second so that the camera
  //! does not jump after a stall. `path` is the current pose on the show's path. Accepts any input:
  //! clamps rates to ±1 and ignores NaN.
  void advance(double seconds, const SteeringInput& input, const CameraPose& path);

  //! Sets the spacetime when the show changes it. A ride continues in the old one. A camera off the
  //! path that does not fall through the horizon moves out to the new guard if it is inside.
  void set_spacetime(Spacetime spacetime);

  //! Takes the camera off the path with its velocity. In mode `geodesic`, or too close to the
  //! horizon to escape, it continues the path's fall if visitors may fall through the horizon.
  //! Calls reset() instead if the show's settings say so, or inside the horizon if the fall cannot
  //! continue.
  void leave_path();
  //! Flies back to the path and then follows it; jumps there if the camera is committed() or the
  //! path is inside the horizon. Does nothing unless the camera is in free flight.
  void return_to_path();
  //! Restarts free flight in the show's flight mode, at rest at the show's first camera key.
  void reset();

  //! Turns the view of a camera off its path, in which it flies, to that of a viewer's head.
  //! `orientation` rotates the view's axes into level ones (ViewerHead::look).
  void look(const glm::dquat& orientation);

  void set_mode(FlightMode mode);
  //! Selects the next flight mode and takes the camera off the path. If the path is in free fall,
  //! the first mode is to continue that fall.
  void next_mode();
  //! Reverses the direction of circular orbits and ends a ride, so that the mode `geodesic` starts
  //! a circular orbit. The ride of a committed() camera continues.
  void reverse_orbit();
  //! Starts free fall with a velocity in the ZAMO frame; does nothing if the camera is committed().
  //! Throws Error unless the velocity is slower than light.
  void ride(const Vector3<double>& velocity);
  //! Starts free fall from rest in the ZAMO frame, into the hole. If the camera or its path already
  //! falls through the horizon, continues that fall.
  void let_go();

  //! Returns the camera's pose. Off the path, it has a velocity only if the camera falls through
  //! the horizon.
  [[nodiscard]] CameraPose pose() const;
  //! Returns the camera's proper time since it began to fall through the horizon, or was taken from
  //! a path that does [M]. Returns nothing on the path, or if the camera does not fall so.
  [[nodiscard]] std::optional<double> proper_time() const {
    return course_ != Course::path && falls_through() ? std::optional(ride_->proper_time()) : std::nullopt;
  }
  [[nodiscard]] Course course() const { return course_; }
  [[nodiscard]] FlightMode mode() const { return mode_; }
  //! Returns whether the last `advance` changed the pose.
  [[nodiscard]] bool moved() const { return moved_; }

  //! Returns how the camera itself moves off the path, if that determines the observer: on an
  //! orbit, or hovering. Otherwise, and on the way back, returns nothing.
  [[nodiscard]] std::optional<ObserverView> flight_observer(std::string_view language = "en") const;

  //! Returns whether the camera, off its path, cannot escape: inside the horizon or very close to
  //! it. Only `reset` and `return_to_path` can then move it elsewhere.
  [[nodiscard]] bool committed() const;

  //! Returns the name of the flight mode, for the screen.
  [[nodiscard]] std::string_view mode_name(std::string_view language = "en") const;

  //! turn_rate() returns the rotation rate of the view relative to fixed directions [rad/s],
  //! fly_velocity() the velocity of flying as a spaceship or on an orbit [distances/s]. The limits
  //! of comfort apply to both.
  [[nodiscard]] const glm::dvec3& turn_rate() const { return turn_; }
  [[nodiscard]] const glm::dvec3& fly_velocity() const { return motion_.fly(); }
  [[nodiscard]] const FlightSpace& space() const { return space_; }

 private:
  void step(const Steering& steering, double seconds);
  void begin_ride();
  void end_ride();
  void fall_on();
  [[nodiscard]] bool falls_through() const { return ride_ && ride_->leads_through_horizon(); }
  [[nodiscard]] bool may_fall_on() const;
  [[nodiscard]] glm::dvec3 turn_of_azimuth() const;
  [[nodiscard]] ObserverView observer_on_ride(std::string_view language) const;
  void move_around(double seconds, glm::dvec3& turn);
  void move_on_orbit(double hurry, double seconds, glm::dvec3& turn);
  void turn_view(const glm::dvec3& wanted, double seconds);
  void level_east();
  void take_east_from_view();
  void take_velocity_of(const CameraPlacement& before, const CameraPlacement& now, double seconds,
                        const FlightSpace& space);
  void advance_return(double seconds);
  void start_return();

  Spacetime spacetime_;
  FlightSettings settings_;
  FlightSpace space_;
  SteeredMotion motion_;
  //! Reason why visitors cannot fall through the horizon; empty if they can.
  std::optional<LocalText> kept_outside_;
  bool leads_through_;  //!< whether infalling orbits lead through the horizon
  CameraPlacement start_;
  CameraPlacement placement_;
  Course course_ = Course::path;
  FlightMode mode_;
  bool path_falls_;
  double orbit_sense_ = 1.0;
  CameraPose path_;         //!< pose on the show's path in the last frame
  CameraPose path_before_;  //!< pose on the path in the frame before
  CameraPlacement before_;
  double frame_s_ = 0.0;  //!< time step of the last frame [s], at most a tenth of a second
  bool begun_ = false;
  bool moved_ = true;
  glm::dvec3 turn_{0.0};
  //! The visitor's east, ±east_at(): horizontal and perpendicular to `towards`. It does not reverse
  //! where the camera crosses the spin axis.
  glm::dvec3 east_{0.0, 1.0, 0.0};
  //! The current ride, if any. During one through the horizon, `placement_` and `before_` have
  //! ingoing Kerr azimuths.
  std::optional<OrbitRide> ride_;
  Vector3<double> ride_before_{};  //!< velocity of the ride at `before_`
  double clock_lead_ = 0.0;        //!< pose.clock_lead while not falling through the horizon [M]
  //! Value of pose.clock_lead minus outer_lag() while the camera falls through the horizon [M].
  double lead_over_lag_ = 0.0;
  std::optional<Vector3<double>> asked_velocity_;
  std::optional<PathReturn> return_;
};

}  // namespace ergodome
