#include "calibration/warps/lens.h"

#include "kernels/core/angles.h"

namespace ergodome {

double growing_angle(const std::vector<double>& polynomial) {
  constexpr int steps = 1800;
  double reached = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double t = pi * i / steps;
    double slope = 0.0;
    double power = 1.0;
    for (std::size_t k = 0; k < polynomial.size(); ++k, power *= t * t) {
      slope += (2.0 * static_cast<double>(k) + 1.0) * polynomial[k] * power;
    }
    if (!(slope > 0.0)) {
      break;
    }
    reached = t;
  }
  return reached;
}

}  // namespace ergodome
