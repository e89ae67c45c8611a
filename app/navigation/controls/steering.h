#pragma once

namespace ergodome {

//! Steering of a camera along its own axes, by keys, mouse and controllers together: rates from -1
//! to 1, or amounts of motion (see SteeringInput).
struct Steering {
  double right = 0.0;
  double up = 0.0;
  double forward = 0.0;
  double yaw = 0.0;     //!< turn to the right
  double pitch = 0.0;   //!< turn up
  double roll = 0.0;    //!< turn clockwise
  double zoom = 0.0;    //!< positive: smaller field of view
  double faster = 0.0;  //!< 0 to 1: up to the maximum comfortable speed

  bool operator==(const Steering&) const = default;
};

//! Steering input of a frame.
struct SteeringInput {
  Steering rates;  //!< from keys, buttons and sticks: rates, which apply while these are held
  //! Motion of the mouse: rotations [rad], translations [distances to the guard surface], zoom in
  //! steps of the wheel.
  Steering amounts;
};

}  // namespace ergodome
