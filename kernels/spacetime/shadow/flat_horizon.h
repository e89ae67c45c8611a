#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/spacetime/shadow/edge_curve.h"

namespace ergodome {

//! The horizon as an eye of the stereo model `flat` sees it: its nearness (1/distance) along the
//! eye's lines of sight. The table is over position angles about the shadow's center and over
//! depths ln(α_edge / (α_edge - α)) inside the edge, both in equal steps; α is the angle from the
//! shadow's center.
struct FlatHorizon {
  EdgeCurve edge;         //!< edge of the eye's shadow, in the observer's frame
  float cosine_largest;   //!< cosine of the largest polar angle of the edge
  const float* nearness;  //!< nearness of the horizon [1/M]; `spokes` rows of `depths` values
  int spokes;
  int depths;
  float depth_step;
};

inline namespace ERGO_TARGET {

//! Returns whether the horizon hides the point at nearness w on an eye's line of sight in direction
//! `m` (kernels/eyes/flat/eye_line.h).
ERGO_HD bool is_behind_horizon(const FlatHorizon& horizon, const Vector3<float>& m, float w) {
  const EdgeCurve& edge = horizon.edge;
  const float ahead = dot(m, edge.centre);
  // Most directions are outside the shadow; for them, the cosine alone decides.
  if (ahead < horizon.cosine_largest) {
    return false;
  }
  const float p = dot(m, edge.first);
  const float q = dot(m, edge.second);
  const float gamma = ::atan2f(q, p);
  const float alpha = ::atan2f(::sqrtf(p * p + q * q), ahead);
  float edge_alpha = 0.0F;
  float slope = 0.0F;
  edge_at(edge, gamma, edge_alpha, slope);
  if (!(alpha < edge_alpha)) {
    return false;
  }
  const float turns = gamma * 0.159154943F;
  const float across = (turns < 0.0F ? turns + 1.0F : turns) * static_cast<float>(horizon.spokes);
  const float down = -::logf(maximum(1.0F - alpha / edge_alpha, 1e-7F)) / horizon.depth_step;
  const int spoke = static_cast<int>(across);
  const int depth = static_cast<int>(minimum(down, static_cast<float>(horizon.depths) - 1.5F));
  const float s = across - static_cast<float>(spoke);
  const float t = minimum(down - static_cast<float>(depth), 1.0F);
  const auto read = [&](int row) {
    const float* const at = horizon.nearness + (row % horizon.spokes) * horizon.depths + depth;
    return at[0] + t * (at[1] - at[0]);
  };
  return w < read(spoke) + s * (read(spoke + 1) - read(spoke));
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
