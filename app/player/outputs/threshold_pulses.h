#pragma once

#include <array>
#include <optional>

#include "kernels/spacetime/spacetime.h"

namespace ergodome {

//! A vibration of the controllers.
struct ThresholdPulse {
  double strength = 0.0;  //!< 0 to 1
  double duration_s = 0.0;

  bool operator==(const ThresholdPulse&) const = default;
};

//! Decides when controllers vibrate: when the camera crosses the radius of one of the equatorial
//! photon orbits, or the horizon, inward or outward. After that, a threshold does not vibrate again
//! until the camera has left its neighborhood, so hovering there has no effect. Jumps of the camera
//! do not count as crossings.
class ThresholdPulses {
 public:
  //! Returns the pulse of a frame; the strongest if it crosses several thresholds. `r` is the
  //! camera's radius [M].
  std::optional<ThresholdPulse> advance(Spacetime spacetime, double r);

  //! Forgets the camera, for example because another show starts.
  void begin() { last_r_.reset(); }

 private:
  struct Threshold {
    bool inside = false;  //!< side of the camera when it was last away from the threshold
    bool crossed = false;
  };

  //! Both photon orbits, then the horizon.
  std::array<Threshold, 3> thresholds_;
  std::optional<double> last_r_;
};

}  // namespace ergodome
