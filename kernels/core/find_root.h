#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

namespace ergodome::inline ERGO_TARGET {

//! Returns where an increasing continuous function crosses zero in [low, high], to rounding.
//! Returns `low` if the function is not negative at `low`, and `high` if it is not positive at
//! `high`.
//!
//! Inverse quadratic interpolation where safe, otherwise bisection: T. R. Chandrupatla, Advances in
//! Engineering Software 28 (1997) 145.
template <class Function>
ERGO_HD double find_root(double low, double high, const Function& function) {
  constexpr int max_rounds = 120;
  double a = low;
  double b = high;
  double value_a = function(a);
  double value_b = function(b);
  if (!(value_a < 0.0)) {
    return a;
  }
  if (!(value_b > 0.0)) {
    return b;
  }
  double share = 0.5;
  double best = a;
  for (int round = 0; round < max_rounds; ++round) {
    const double x = a + share * (b - a);
    const double value = function(x);
    const bool with_a = (value > 0.0) == (value_a > 0.0);
    const double c = with_a ? a : b;
    const double value_c = with_a ? value_a : value_b;
    if (!with_a) {
      b = a;
      value_b = value_a;
    }
    a = x;
    value_a = value;
    best = ::fabs(value_a) < ::fabs(value_b) ? a : b;
    const double tolerance = 2.3e-16 * ::fabs(best) + 1e-300;
    const double limit = tolerance / ::fabs(b - a);
    if (limit > 0.5 || value_a == 0.0) {
      break;
    }
    const double xi = (a - b) / (c - b);
    const double phi = (value_a - value_b) / (value_c - value_b);
    share = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
      share = value_a / (value_b - value_a) * value_c / (value_b - value_c) +
              (c - a) / (b - a) * value_a / (value_c - value_a) * value_b / (value_c - value_b);
    }
    share = ::fmin(1.0 - limit, ::fmax(limit, share));
  }
  return best;
}

}  // namespace ergodome::inline ERGO_TARGET
