#pragma once

#include <cmath>

#include "kernels/lens/lens_chart.h"

namespace ergodome {

//! Angle between the shadow's edge and a place in the chart, about [rad].
inline double edge_distance(const LensChart& chart, double s) {
  return 3.0 * std::exp((s - 1.0) * static_cast<double>(chart.range));
}

//! Errors on the sky of rays that are traced in float for images of stars.
inline constexpr double float_tolerance = 5e-7;

//! What such rays' rounding changes a magnification by, as a part of it, times the distance to the shadow's edge [rad]: it is amplified by
//! more in none of 4,200 images about six holes, spins 0 to 0.999.
inline constexpr double edge_rounding = 32.0 * float_tolerance;

}  // namespace ergodome
