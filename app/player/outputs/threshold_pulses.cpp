#include "app/player/outputs/threshold_pulses.h"

#include <cmath>

namespace ergodome {

namespace {

constexpr ThresholdPulse photon_orbit_pulse{.strength = 0.4, .duration_s = 0.1};
constexpr ThresholdPulse horizon_pulse{.strength = 1.0, .duration_s = 0.3};

//! The neighborhood of a threshold, relative to its radius.
constexpr double near_threshold = 0.01;
//! Relative change of the radius within a frame beyond which the camera jumped.
constexpr double jump_of_radius = 0.25;

}  // namespace

std::optional<ThresholdPulse> ThresholdPulses::advance(Spacetime spacetime, double r) {
  if (!(r > 0.0)) {
    return std::nullopt;
  }
  const bool moved = last_r_ && std::abs(r - *last_r_) <= jump_of_radius * *last_r_;
  last_r_ = r;
  const std::array<double, 3> radii = {photon_orbit_radius(spacetime, 1.0), photon_orbit_radius(spacetime, -1.0),
                                       horizon_radius(spacetime)};
  std::optional<ThresholdPulse> strongest;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    Threshold& threshold = thresholds_[i];
    const bool inside = r < radii[i];
    if (moved && !threshold.crossed && inside != threshold.inside) {
      threshold.crossed = true;
      const ThresholdPulse& pulse = i == 2 ? horizon_pulse : photon_orbit_pulse;
      if (!strongest || strongest->strength < pulse.strength) {
        strongest = pulse;
      }
    }
    if (!moved || std::abs(r - radii[i]) > near_threshold * radii[i]) {
      threshold = {.inside = inside, .crossed = false};
    }
  }
  return strongest;
}

}  // namespace ergodome
