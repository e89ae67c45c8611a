#pragma once

#include <cmath>

#include "kernels/core/vector3.h"

namespace ergodome {

//! The shadow's edge on a camera's sky as a table: polar angle α about the chart's center at equal
//! steps of the position angle γ.
//!
//! The curve is smooth and periodic, so a cubic through four neighbors is accurate to the rounding
//! of float with a few hundred points.
struct EdgeCurve {
  Vector3<float> centre;  //!< axes of the chart, see ShadowChart
  Vector3<float> first;
  Vector3<float> second;
  const float* polar_angle;  //!< α at γ = 2π i / count [rad]
  int count;
  float smallest;  //!< smallest α of the edge [rad]
  float largest;   //!< largest α of the edge [rad]
};

inline namespace ERGO_TARGET {

//! Computes α and dα/dγ at a position angle.
ERGO_HD void edge_at(const EdgeCurve& edge, float gamma, float& alpha, float& slope) {
  const float steps_per_radian = static_cast<float>(edge.count) * 0.159154943F;
  const float position = gamma * steps_per_radian;
  const float whole = ::floorf(position);
  const float t = position - whole;
  const int count = edge.count;
  const auto wrapped = [count](int i) { return i < 0 ? i + count : (i >= count ? i - count : i); };
  // A NaN angle has no index, so index 0 is used; α is NaN nevertheless, because t is.
  const float known = ::fabsf(whole) < 1e7F ? whole : 0.0F;
  // Avoids an integer division, which would take longer than the rest of this function.
  const int turns = static_cast<int>(known / static_cast<float>(count));
  const int i = wrapped(static_cast<int>(known) - turns * count);
  const float p0 = edge.polar_angle[wrapped(i - 1)];
  const float p1 = edge.polar_angle[i];
  const float p2 = edge.polar_angle[wrapped(i + 1)];
  const float p3 = edge.polar_angle[wrapped(i + 2)];
  // Catmull and Rom: value p1 and slope (p2 - p0) / 2 at t = 0, likewise at t = 1.
  const float b = 0.5F * (p2 - p0);
  const float c = p0 - 2.5F * p1 + 2.0F * p2 - 0.5F * p3;
  const float d = 0.5F * (p3 - p0) + 1.5F * (p1 - p2);
  alpha = p1 + t * (b + t * (c + t * d));
  slope = (b + t * (2.0F * c + 3.0F * t * d)) * steps_per_radian;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
