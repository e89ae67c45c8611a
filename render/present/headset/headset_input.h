#pragma once

#include <array>

namespace ergodome {

//! The state of one hand's controller, or of a tracked hand with gestures; initially at rest.
struct HeadsetHand {
  bool connected = false;
  double stick_x = 0.0;  //!< thumbstick or trackpad, to the right, -1 to 1
  double stick_y = 0.0;  //!< forward, -1 to 1
  double trigger = 0.0;  //!< index finger, a pinch, or the only selecting button, 0 to 1
  double grip = 0.0;     //!< 0 to 1
  bool lower = false;    //!< button A or X
  bool upper = false;    //!< button B or Y
  bool stick = false;    //!< the thumbstick is pressed
  bool menu = false;
  //! Whether it has a thumbstick or a trackpad; hands and simple controllers have neither.
  bool has_stick = true;

  bool operator==(const HeadsetHand&) const = default;
};

//! Both hands, the left one first.
using HeadsetHands = std::array<HeadsetHand, 2>;

}  // namespace ergodome
