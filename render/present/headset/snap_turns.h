#pragma once

#include <cmath>

namespace ergodome {

//! Turns the position of a thumbstick into snap turns: one for each push. A push must be followed
//! by a release, so that a shaking hand does not turn twice.
class SnapTurns {
 public:
  //! Returns the snap turn that a frame requests: 1 to the right, -1 to the left, 0 none. `axis` is
  //! the stick's position from -1 to 1, positive to the right; NaN counts as 0.
  int turn(double axis) {
    constexpr double pushed = 0.7;
    constexpr double released = 0.4;
    const double now = std::isnan(axis) ? 0.0 : axis;
    if (now * side_ < released) {
      side_ = 0;
    }
    if (side_ != 0 || !(std::abs(now) > pushed)) {
      return 0;
    }
    side_ = now > 0.0 ? 1 : -1;
    return side_;
  }

 private:
  int side_ = 0;  //!< side to which the stick is pushed: 1, -1, or 0 if it was released
};

}  // namespace ergodome
