#include "render/passes/overlay/camera_readout.h"

#include <fmt/format.h>

#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double max_width_deg = 170.0;

//! Returns a distance with two decimals below 1000, otherwise with four significant digits.
std::string distance_text(double r) { return fmt::format(fmt::runtime(r < 1000.0 ? "{:.2f}" : "{:.4g}"), r); }

}  // namespace

LocalText readout_text(Spacetime spacetime, double r, double theta) {
  // Adding 0 turns -0 into 0.
  const double latitude_deg = std::round(10.0 * (90.0 - radian_deg * theta)) / 10.0 + 0.0;
  const std::string distance = distance_text(r);
  return {{"en", fmt::format("spin a/M {:.4g}, distance r {} M, latitude {:.1f}\u00b0", spacetime.spin, distance,
                             latitude_deg)},
          {"de", fmt::format("Spin a/M {:.4g}, Abstand r {} M, Breite {:.1f}\u00b0", spacetime.spin, distance,
                             latitude_deg)}};
}

Caption readout_caption(const ReadoutSettings& readout, Spacetime spacetime, double r, double theta) {
  Caption caption;
  caption.position = readout.position;
  caption.letter_deg = readout.letter_deg;
  caption.width_deg = max_width_deg;
  caption.text = readout_text(spacetime, r, theta);
  return caption;
}

}  // namespace ergodome
