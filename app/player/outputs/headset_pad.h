#pragma once

#include <limits>
#include <memory>

#include "app/pads/pad_hub.h"
#include "render/present/headset/headset_input.h"

namespace ergodome {

//! Converts the controllers of a headset to the state of a pad, with the default dead zones and
//! response curves of pads: sticks, triggers, grips as shoulder buttons, and buttons by position.
//! The trigger of a hand without a stick moves the camera instead: forward in the right hand, back
//! in the left one. The stick of a single controller moves forward and back, and turns. Menu
//! buttons, which recenter the view, are left out. `before` is the last state; triggers and grips count as buttons until they are released far enough.
PadState pad_of(const HeadsetHands& hands, const PadState& before = {});

//! The controllers of a headset as one more pad. Counts presses, and remembers the last input.
class HeadsetPad {
 public:
  HeadsetPad();

  //! Adds the pad to the pads of a frame if at least one controller is connected. Call it once per
  //! frame.
  void add_to(PadSnapshot& pads, const HeadsetHands& hands);

 private:
  std::shared_ptr<const PadIdentity> identity_;
  PadState state_;
  double last_input_s_ = -std::numeric_limits<double>::infinity();
  long frames_ = 0;
};

}  // namespace ergodome
