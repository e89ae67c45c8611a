#pragma once

#include "kernels/lens/lens_chart.h"
#include "kernels/lens/lens_grid.h"

// A chart of a camera's whole sky, within the shadow and outside: position angle γ about the
// shadow's center [turns], and s in [0, 1].
//
// With α the polar angle from that center and α_e(γ) the shadow's edge,
//   s = α (π - α_e) / (α (π - α_e) + α_e (π - α)):
// the center is s = 0, the edge s = 1/2, the direction opposite to the center s = 1. Where light
// crosses the equatorial plane is a smooth function at the edge, since light crosses at a finite
// Mino time, whatever becomes of it later. But the higher the order of the crossing, the faster
// this function changes across the edge. So the edge is a line of constant s, along which cells may
// be thin. Inverse: α = π α_e s / (π (1 - s) - α_e (1 - 2 s)).
namespace ergodome::inline ERGO_TARGET {

//! Position of a direction in the chart, with the same derivatives as the direction.
template <class T>
struct DiskPosition {
  Dual<T> gamma_turns;  //!< position angle γ [turns], in [0, 1)
  Dual<T> s;
};

//! Returns the position in the chart of a unit direction in the rain frame.
template <class T>
ERGO_HD DiskPosition<T> disk_position(const EdgeCurve& edge, const Vector3<Dual<T>>& n) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  const auto [gamma, alpha, edge_alpha] = polar_position(edge, n);
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

//! Position of one lane in the cells of a disk's grid, with its derivatives per pixel of the
//! rendered picture: along x (to the right) and y (downwards).
struct DiskLanePosition {
  float gamma_turns;
  float s;
  float gamma_along_x, gamma_along_y;
  float s_along_x, s_along_y;

  //! Converts derivatives along γ and s to the derivative per pixel to the right in the rendered
  //! picture.
  [[nodiscard]] ERGO_HD float along_x(float along_gamma, float along_s) const {
    return along_gamma * gamma_along_x + along_s * s_along_x;
  }
  //! Converts derivatives along γ and s to the derivative per pixel downwards in the rendered
  //! picture.
  [[nodiscard]] ERGO_HD float along_y(float along_gamma, float along_s) const {
    return along_gamma * gamma_along_y + along_s * s_along_y;
  }
};

//! Returns the position of lane `i`. If the grid covers only half of the sky, positions in the
//! other half are mirrored to -γ.
template <class T>
ERGO_HD DiskLanePosition disk_lane_position(const LensGrid& cells, const DiskPosition<T>& position, int i) {
  const float turns = lane(position.gamma_turns.value, i);
  const bool over = cells.mirrored != 0 && turns > 0.5F;
  const float side = over ? -1.0F : 1.0F;
  return {over ? 1.0F - turns : turns,
          lane(position.s.value, i),
          side * lane(position.gamma_turns.along_x, i),
          side * lane(position.gamma_turns.along_y, i),
          lane(position.s.along_x, i),
          lane(position.s.along_y, i)};
}

}  // namespace ergodome::inline ERGO_TARGET
