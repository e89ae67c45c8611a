#pragma once

#include "kernels/core/dual.h"
#include "kernels/core/transcendental.h"
#include "kernels/spacetime/shadow/edge_curve.h"

namespace ergodome {

//! The chart of a camera's sky, in the rain frame: position angle γ about the shadow's center, in
//! turns, and s in [0, 1].
//!
//! With x the fraction of the way from the shadow's edge to the far pole of the chart, s = 1 + ln x
//! / range. The edge is the line s -> -infinity; near it, the sky direction turns around the hole
//! at a constant rate in s. s = 1 is the far pole, and s = 0 the cut-off.
struct LensChart {
  EdgeCurve edge;
  float range;  //!< rise of ln x from cut-off to far pole; x: fraction of the way from the edge
};

//! Position of a direction in the chart.
template <class T>
struct ChartPosition {
  T gamma_turns;  //!< position angle γ [turns], in [0, 1)
  T s;            //!< at most 1; below 0 beyond the cut-off
  //! Angle from the shadow's edge along the circle through the chart's center; negative in the
  //! shadow [rad].
  T edge_distance;
};

inline namespace ERGO_TARGET {

//! Computes the shadow's edge at a position angle [rad]: its angle α from the shadow's center, and
//! the slope dα/dγ. Like edge_at(), but for any real type, lane by lane.
template <class T>
ERGO_HD void edge_lanes(const EdgeCurve& edge, const T& gamma, T& alpha, T& slope) {
  using S = ScalarOf<T>;
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    float value = 0.0F;
    float rate = 0.0F;
    edge_at(edge, static_cast<float>(lane(gamma, i)), value, rate);
    set_lane(alpha, i, S(value));
    set_lane(slope, i, S(rate));
  }
}

//! A direction in polar coordinates about the shadow's center, and the shadow's edge at its
//! position angle [rad], with the same derivatives as the direction.
template <class T>
struct PolarPosition {
  Dual<T> gamma;       //!< γ: position angle about the center
  Dual<T> alpha;       //!< α: angle between the direction and the center
  Dual<T> edge_alpha;  //!< angle between the shadow's edge and the center
};

//! Returns the polar coordinates of a unit direction in the rain frame. Always inlined: its callers
//! use the results at once, and a call would return nine registers in memory.
template <class T>
[[gnu::always_inline]] ERGO_HD PolarPosition<T> polar_position(const EdgeCurve& edge, const Vector3<Dual<T>>& n) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  const auto along = [&](const Vector3<float>& axis) { return n.x * S(axis.x) + n.y * S(axis.y) + n.z * S(axis.z); };
  const D c = along(edge.centre);
  const D p = along(edge.first);
  const D q = along(edge.second);
  // At the chart's poles γ is undefined; a small term in the square of the sine keeps its
  // derivative finite.
  const D square = p * p + q * q + D(T(S(1e-30)));
  const D sine = sqrt(square);
  const T inverse_square = S(1) / square.value;
  const auto turned = [&](const T& dp, const T& dq) { return (p.value * dq - q.value * dp) * inverse_square; };
  const D gamma = {arc_tangent(q.value, p.value), turned(p.along_x, q.along_x), turned(p.along_y, q.along_y)};
  const auto opened = [&](const T& ds, const T& dc) { return c.value * ds - sine.value * dc; };
  const D alpha = {arc_tangent(sine.value, c.value), opened(sine.along_x, c.along_x), opened(sine.along_y, c.along_y)};
  T edge_value;
  T slope;
  edge_lanes(edge, gamma.value, edge_value, slope);
  return {gamma, alpha, {edge_value, slope * gamma.along_x, slope * gamma.along_y}};
}

//! Returns the position in the chart of a unit direction in the rain frame.
template <class T>
ERGO_HD ChartPosition<Dual<T>> chart_position(const LensChart& chart, const Vector3<Dual<T>>& n) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  const auto [gamma, alpha, edge_alpha] = polar_position(chart.edge, n);
  const D distance = alpha - edge_alpha;
  const D fraction = distance / (T(S(3.14159265358979323846)) - edge_alpha);
  const T x = maximum(fraction.value, T(S(1e-30)));
  const T inverse_x = S(1) / (x * S(chart.range));
  const D s = {S(1) + natural_logarithm(x) * (S(1) / S(chart.range)), fraction.along_x * inverse_x,
               fraction.along_y * inverse_x};
  const T one(S(1));
  const D turns = gamma * S(0.159154943091895335769);
  const auto negative = turns.value < T(S(0));
  return {select(negative, turns + one, turns), s, distance};
}

//! The chart's stretch at a position: the angle α from the shadow's center [rad], with its
//! derivatives along γ [turns] and s.
template <class T>
struct ChartStretch {
  MixedDual<T> alpha;
  T fraction;    //!< x: fraction of the way from the shadow's edge to the far pole
  T edge_alpha;  //!< α of the shadow's edge
};

template <class T>
ERGO_HD ChartStretch<T> chart_stretch(const LensChart& chart, const T& gamma_turns, const T& s) {
  using S = ScalarOf<T>;
  constexpr S turn = S(6.28318530717958647692);
  const S range = S(chart.range);
  T edge_alpha;
  T slope;
  edge_lanes(chart.edge, gamma_turns * turn, edge_alpha, slope);
  slope = slope * turn;
  const T x = exponential((s - S(1)) * range);
  const T rest = S(3.14159265358979323846) - edge_alpha;
  return {{edge_alpha + rest * x, slope * (S(1) - x), rest * x * range, -(slope * x * range)}, x, edge_alpha};
}

//! Returns the unit vector in the rain frame at position angle γ [turns] and at the angle `alpha`
//! from the shadow's center (see ChartStretch), with its derivatives along γ [turns] and s.
template <class T>
ERGO_HD Vector3<MixedDual<T>> chart_direction_at(const LensChart& chart, const T& gamma_turns,
                                                 const MixedDual<T>& alpha) {
  using S = ScalarOf<T>;
  using M = MixedDual<T>;
  constexpr S turn = S(6.28318530717958647692);
  const T zero(S(0));
  M sine_alpha;
  M cosine_alpha;
  M sine_gamma;
  M cosine_gamma;
  sine_cosine(alpha, sine_alpha, cosine_alpha);
  sine_cosine(M(gamma_turns * turn, T(turn), zero, zero), sine_gamma, cosine_gamma);
  const M first = sine_alpha * cosine_gamma;
  const M second = sine_alpha * sine_gamma;
  const EdgeCurve& e = chart.edge;
  const auto component = [&](float c, float f, float h) { return cosine_alpha * S(c) + first * S(f) + second * S(h); };
  return {component(e.centre.x, e.first.x, e.second.x), component(e.centre.y, e.first.y, e.second.y),
          component(e.centre.z, e.first.z, e.second.z)};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
