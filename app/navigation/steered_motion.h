#pragma once

#include <glm/gtc/quaternion.hpp>

#include "app/navigation/controls/steering.h"
#include "app/navigation/turn_limits.h"
#include "content/show/flight_settings.h"

namespace ergodome {

//! Returns the steering with each value limited to ±`maximum` and `faster` to 0 to 1; NaN becomes
//! 0.
Steering limited_steering(const Steering& steering, double maximum);

//! The motion that a visitor steers: rates that follow keys, sticks and mouse within the limits of
//! comfort.
class SteeredMotion {
 public:
  explicit SteeredMotion(const FlightSettings& settings)
      : limits_(turn_limits(settings.comfort)),
        max_speed_(settings.max_speed),
        max_acceleration_(settings.comfort.accel) {}

  //! Adds a motion of the mouse, which the next steps carry out. The motion still to be carried out
  //! is limited to 3.2 rad and two distances.
  void add_mouse(const Steering& amounts);
  //! Discards the remaining motion of the mouse.
  void forget_mouse() { mouse_turn_ = mouse_way_ = glm::dvec3(0.0); }

  //! Changes the rates for a step of a flight mode. `view` is the camera's orientation; `eastward`,
  //! -1 to 1, is the direction in which a step to the right goes around the spin axis.
  void follow_steering(const Steering& rates, FlightMode mode, const glm::dquat& view, double eastward, double seconds);

  //! Stops looking and going around, and moves as a ship with this velocity [distances/s].
  void move_as_ship(const glm::dvec3& fly);

  //! Returns whether the camera still goes around the hole or flies.
  [[nodiscard]] bool coasts() const;

  [[nodiscard]] const TurnLimits& limits() const { return limits_; }
  //! Returns the rotation rate about the view's axes [rad/s].
  [[nodiscard]] const glm::dvec3& head() const { return head_; }
  //! Returns the rates to the camera's east and north [rad/s] and outward [distances/s].
  [[nodiscard]] const glm::dvec3& around() const { return around_; }
  //! Returns the velocity as a ship [distances/s].
  [[nodiscard]] const glm::dvec3& fly() const { return fly_; }
  //! Sets the velocity that fly() returns [distances/s], for a camera in free fall, whose orbit
  //! determines it instead of the steering.
  void set_fly(const glm::dvec3& fly) { fly_ = fly; }

 private:
  //! Returns the velocity at which the remaining translation by the mouse (`mouse_way_`) is
  //! followed in this step, at most `max_speed_`, and subtracts the step from it.
  glm::dvec3 take_mouse_way(double seconds);

  TurnLimits limits_;
  double max_speed_;
  double max_acceleration_;
  glm::dvec3 head_{0.0};
  glm::dvec3 around_{0.0};
  glm::dvec3 fly_{0.0};
  glm::dvec3 mouse_turn_{0.0};  //!< remaining pitch, yaw, roll [rad]
  glm::dvec3 mouse_way_{0.0};   //!< remaining right, up, forward [distances]
};

}  // namespace ergodome
