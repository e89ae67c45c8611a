#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

namespace ergodome::inline ERGO_TARGET {

//! Computes R_F(x, y, z) = ½ ∫_0^∞ dt / √((t + x)(t + y)(t + z)) of real arguments that are not
//! negative, at most one of them zero. Uses duplication like the complex version (carlson.h) in a
//! fraction of the time. B. C. Carlson, Numerical Algorithms 10 (1995) 13; DLMF 19.36.
ERGO_HD double carlson_rf_real(double x, double y, double z) {
  constexpr int duplication_limit = 700;  // arguments that are 1e400 apart
  double mean = (x + y + z) / 3.0;
  for (int round = 0; round < duplication_limit; ++round) {
    const double spread = ::fmax(::fabs(x - mean), ::fmax(::fabs(y - mean), ::fabs(z - mean)));
    if (spread < 2e-3 * mean) {
      break;
    }
    const double rx = ::sqrt(x);
    const double ry = ::sqrt(y);
    const double rz = ::sqrt(z);
    const double lambda = rx * (ry + rz) + ry * rz;
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
    mean = (x + y + z) / 3.0;
  }
  const double dx = (mean - x) / mean;
  const double dy = (mean - y) / mean;
  const double dz = -dx - dy;
  const double e2 = dx * dy - dz * dz;
  const double e3 = dx * dy * dz;
  const double series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - e2 * e3 * 3.0 / 44.0 -
                        e2 * e2 * e2 * 5.0 / 208.0 + e3 * e3 * 3.0 / 104.0;
  return series / ::sqrt(mean);
}

}  // namespace ergodome::inline ERGO_TARGET
