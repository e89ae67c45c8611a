#pragma once

namespace ergodome {

//! What a person asks of a camera right now, by keys, mouse and pads together: rates from -1 to 1 in the camera's own axes.
struct Steering {
  double right = 0.0;
  double up = 0.0;
  double forward = 0.0;
  double yaw = 0.0;     //!< to the right
  double pitch = 0.0;   //!< upwards
  double roll = 0.0;    //!< clockwise
  double zoom = 0.0;    //!< positive: a smaller field of view
  double faster = 0.0;  //!< 0 to 1: up to the largest speed that comfort allows

  bool operator==(const Steering&) const = default;
};

}  // namespace ergodome
