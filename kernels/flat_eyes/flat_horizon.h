#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/shadow/edge_curve.h"

namespace ergodome {

//! The horizon in a head's flat tangent space, where it is dark: its affine distance by position angles about the shadow's chart, and by depths
//! from the edge inwards, ln(α_edge / (α_edge - α)) at equal steps.
struct FlatHorizon {
  EdgeCurve edge;         //!< of the head's shadow, in the observer's frame
  EdgeCurve eye_edge;     //!< and what the eye sees of it: outside the horizon hides nothing
  const float* distance;  //!< [M]; spokes rows of `depths`
  int spokes;
  int depths;
  float depth_step;
  float most_w;          //!< 1 / the least distance
  float cosine_largest;  //!< of the greatest polar angle of the eye's edge
};

inline namespace ERGO_TARGET {

namespace detail {

//! Whether a direction is within an edge.
ERGO_HD bool is_within(const EdgeCurve& edge, const Vector3<float>& n) {
  const float p = dot(n, edge.first);
  const float q = dot(n, edge.second);
  float alpha = 0.0F;
  float slope = 0.0F;
  edge_at(edge, ::atan2f(q, p), alpha, slope);
  return ::atan2f(::sqrtf(p * p + q * q), dot(n, edge.centre)) < alpha;
}

//! Nearness of the horizon in a direction; 0 where that is not dark. Straight between the table's entries, of which each is a few per cent off
//! the next.
ERGO_HD float horizon_nearness(const FlatHorizon& horizon, const Vector3<float>& n) {
  const EdgeCurve& edge = horizon.edge;
  const float p = dot(n, edge.first);
  const float q = dot(n, edge.second);
  const float alpha = ::atan2f(::sqrtf(p * p + q * q), dot(n, edge.centre));
  if (alpha >= edge.largest) {
    return 0.0F;
  }
  const float gamma = ::atan2f(q, p);
  float edge_alpha = 0.0F;
  float slope = 0.0F;
  edge_at(edge, gamma, edge_alpha, slope);
  if (!(alpha < edge_alpha)) {
    return 0.0F;
  }
  const float turns = gamma * 0.159154943F;
  const float across = (turns < 0.0F ? turns + 1.0F : turns) * static_cast<float>(horizon.spokes);
  const float down = minimum(-::logf(maximum(1.0F - alpha / edge_alpha, 1e-7F)) / horizon.depth_step,
                             static_cast<float>(horizon.depths - 1));
  const int spoke = static_cast<int>(across);
  const int depth = static_cast<int>(minimum(down, static_cast<float>(horizon.depths) - 1.5F));
  const float s = across - static_cast<float>(spoke);
  const float t = down - static_cast<float>(depth);
  const auto read = [&](int row) {
    const float* const at = horizon.distance + (row % horizon.spokes) * horizon.depths + depth;
    return at[0] + t * (at[1] - at[0]);
  };
  return 1.0F / (read(spoke) + s * (read(spoke + 1) - read(spoke)));
}

}  // namespace detail

//! Whether an eye that looks in direction `m` sees the horizon before what is at the nearness w on its line of sight (kernels/flat_eyes/eye_line.h).
ERGO_HD bool is_behind_horizon(const FlatHorizon& horizon, const Vector3<float>& m, const Vector3<float>& eye,
                               float w) {
  constexpr int samples = 16;
  const float step = (horizon.most_w - w) / samples;
  // Most directions are beside the shadow, and need no angles to know it.
  if (!(step > 0.0F) || dot(m, horizon.eye_edge.centre) < horizon.cosine_largest ||
      !detail::is_within(horizon.eye_edge, m)) {
    return false;
  }
  for (int i = 1; i <= samples; ++i) {
    const float at = w + static_cast<float>(i) * step;
    const Vector3<float> v = m + at * eye;
    const float length = ::sqrtf(dot(v, v));
    if (length * detail::horizon_nearness(horizon, (1.0F / length) * v) > at) {
      return true;
    }
  }
  return false;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
