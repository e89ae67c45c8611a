#pragma once

#include "kernels/lens/lens_chart.h"

// A chart of a camera's whole sky, within the shadow and outside: position angle γ about the
// shadow's center [turns], and s in [0, 1].
//
// With α the polar angle from that center and α_e(γ) the shadow's edge,
//   s = α (π - α_e) / (α (π - α_e) + α_e (π - α)):
// the center is s = 0, the edge s = 1/2, the direction opposite to the center s = 1. Where light
// crosses the equatorial plane is a smooth function at the edge, since light crosses at a finite
// Mino time, whatever becomes of it later. But across the edge that function changes faster from
// order to order. So the edge is a line of the chart, and cells there may be thin. Inverse: α = π
// α_e s / (π (1 - s) - α_e (1 - 2 s)).
namespace ergodome::inline ERGO_TARGET {

//! Position of a direction in the chart, with its derivatives.
template <class T>
struct DiskPlace {
  Dual<T> gamma_turns;  //!< in [0, 1)
  Dual<T> s;
};

//! Returns the position in the chart of a unit direction in the rain frame.
template <class T>
ERGO_HD DiskPlace<T> disk_place(const EdgeCurve& edge, const Vector3<Dual<T>>& n) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  const auto along = [&](const Vector3<float>& axis) { return n.x * S(axis.x) + n.y * S(axis.y) + n.z * S(axis.z); };
  const D c = along(edge.centre);
  const D p = along(edge.first);
  const D q = along(edge.second);
  // At the chart's poles γ is meaningless. The small addition keeps the derivative of the sine
  // finite.
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
  const D edge_alpha = {edge_value, slope * gamma.along_x, slope * gamma.along_y};
  const D half_turn(T(S(3.14159265358979323846)));
  const D from_centre = alpha * (half_turn - edge_alpha);
  const D s = from_centre / (from_centre + edge_alpha * (half_turn - alpha));
  const D turns = gamma * S(0.159154943091895335769);
  const auto negative = turns.value < T(S(0));
  return {select(negative, turns + T(S(1)), turns), s};
}

//! Returns α at a position, with its derivatives along γ [turns] and s.
template <class T>
ERGO_HD MixedDual<T> disk_polar_angle(const EdgeCurve& edge, const T& gamma_turns, const T& s) {
  using S = ScalarOf<T>;
  using M = MixedDual<T>;
  constexpr S turn = S(6.28318530717958647692);
  const T zero(S(0));
  const T one(S(1));
  T edge_value;
  T slope;
  edge_lanes(edge, gamma_turns * turn, edge_value, slope);
  const M edge_alpha(edge_value, slope * turn, zero, zero);
  const M up(s, zero, one, zero);
  const M half_turn(T(S(3.14159265358979323846)));
  return half_turn * edge_alpha * up / (half_turn * (M(one) - up) - edge_alpha * (M(one) - up - up));
}

}  // namespace ergodome::inline ERGO_TARGET
