#pragma once

#include "kernels/spacetime/geodesic/carlson.h"

// Orbits of light in the plane of a Schwarzschild hole, M = 1: with u = 1/r, azimuth φ and impact
// parameter b,
//   u'² = (du/dφ)² = P(u) = 1/b² - u² + 2u³.
//
// P always has a root -g <= 0. For b > √27 the other two are real. Light from far away turns at the
// smaller one, below 1/3; light from near the hole turns at the larger one. For b < √27 they are a
// complex pair and light never turns. Both families are parametrized by their distance from the
// critical orbit (u = 1/3 twice), because 1/b² alone does not resolve rays near it. All roots and
// all differences of roots that the integrals need follow without cancellation.
//
// Coordinate time along an orbit, dt = b^-1 dφ / (u² (1 - 2u)), is split: with 1/b² - P = u² (1 -
// 2u),
//   t = |Δr*| + ∫ dφ / (1/b + √P),
// where r* = r + 2 ln(r/2 - 1) contains all that diverges at the horizon and at infinity, and the
// integral is small and smooth. Affine distance for energy 1 at infinity, dλ = b^-1 dφ / u², is
// split in the same way:
//   λ = |Δr| + ∫ (1 - 2u) dφ / (1/b + √P).
namespace ergodome::inline ERGO_TARGET {

//! The part of an orbit between two points: its azimuth, its coordinate time minus |Δr*|, and its
//! affine distance minus |Δr|.
struct OrbitLeg {
  double angle;    //!< azimuth about the hole between both points [rad]
  double delay;    //!< coordinate time minus |Δr*| [M]
  double stretch;  //!< affine distance minus |Δr| [M]
};

//! An orbit that turns, b >= √27.
struct TurningOrbit {
  double inverse_b_squared;  //!< 1/b²
  double turn;               //!< u_t: u at which the orbit turns
  //! +1: turns below u = 1/3 and comes from farther out; -1: turns above it and comes from farther
  //! in.
  double side;
  double lowest;  //!< g: P(-g) = 0
  double width;   //!< distance in u from the turn to the third root
};

//! An orbit that never turns, b <= √27. The complex pair of roots is 1/3 + middle ± i spread.
//! Positions on it are given by v = u - 1/3.
struct PlungingOrbit {
  double inverse_b_squared;  //!< 1/b²
  double lowest;             //!< 1/3 + g: P(-g) = 0
  double middle;
  double spread;
};

//! Returns the orbit that turns at u = `turn`. `from_photon_sphere` = |u - 1/3| > 0 on the given
//! side and `from_half` = ½ - u are passed separately, each to its full precision.
ERGO_HD TurningOrbit turning_orbit(double turn, double from_photon_sphere, double from_half, double side) {
  TurningOrbit orbit{};
  orbit.inverse_b_squared = 2.0 * from_half * turn * turn;
  orbit.turn = turn;
  orbit.side = side;
  // The other roots solve u² - (½ - u_t) u - u_t (½ - u_t) = 0.
  const double larger = 0.5 * (from_half + ::sqrt(from_half * (from_half + 4.0 * turn)));
  orbit.lowest = turn * from_half / larger;
  orbit.width = 3.0 * turn * from_photon_sphere / (turn + orbit.lowest);
  return orbit;
}

//! Returns the orbit with g = 1/6 + excess, excess > 0.
ERGO_HD PlungingOrbit plunging_orbit(double excess) {
  PlungingOrbit orbit{};
  const double g = 1.0 / 6.0 + excess;
  orbit.inverse_b_squared = g * g * (1.0 + 2.0 * g);
  orbit.lowest = 1.0 / 3.0 + g;
  orbit.middle = 0.5 * excess;
  orbit.spread = ::sqrt(0.75 * excess * (g + 0.5));
  return orbit;
}

//! Returns √P at `distance` = |u - turn| from the turn.
ERGO_HD double radial_rate(const TurningOrbit& orbit, double distance) {
  const double above = orbit.turn + orbit.lowest - orbit.side * distance;
  return ::sqrt(2.0 * above * distance * (distance + orbit.width));
}

//! Returns √P at v.
ERGO_HD double radial_rate(const PlungingOrbit& orbit, double v) {
  return ::sqrt(2.0 * (v + orbit.lowest)) * ::hypot(v - orbit.middle, orbit.spread);
}

namespace detail {

//! Two integrals over the same range, or their integrands.
struct TwoIntegrals {
  double delay;
  double stretch;

  ERGO_HD void add(double weight, const TwoIntegrals& other) {
    delay += weight * other.delay;
    stretch += weight * other.stretch;
  }
};

//! Integrates over [low, high] by Gauss's rule of 16 points on panels no longer than `longest`.
template <class Integrand>
ERGO_HD TwoIntegrals gauss_16(double low, double high, double longest, const Integrand& integrand) {
  constexpr double position[8] = {0.0950125098376374402, 0.281603550779258913, 0.458016777657227386,
                                  0.617876244402643748,  0.755404408355003034, 0.865631202387831744,
                                  0.944575023073232576,  0.989400934991649933};
  constexpr double weight[8] = {0.189450610455068496,  0.182603415044923589, 0.169156519395002538,
                                0.149595988816576732,  0.124628971255533872, 0.0951585116824927848,
                                0.0622535239386478929, 0.0271524594117540949};
  const int panels = 1 + static_cast<int>(::fmin(::fabs(high - low) / longest, 1e4));
  const double half = 0.5 * (high - low) / panels;
  TwoIntegrals sum{0.0, 0.0};
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = low + half * (2.0 * panel + 1.0);
    for (int i = 0; i < 8; ++i) {
      sum.add(half * weight[i], integrand(middle - half * position[i]));
      sum.add(half * weight[i], integrand(middle + half * position[i]));
    }
  }
  return sum;
}

//! dφ / (1/b + √P) over dy, and the same times 1 - 2u, where |u - turn| = width sinh² y. Outside
//! the horizon the nearest singularity, -g, is at least 0.2 away, so panels are half a unit of y
//! long.
struct TurningDelay {
  TurningOrbit orbit;
  double inverse_b;

  ERGO_HD TwoIntegrals operator()(double y) const {
    const double growth = ::exp(y);
    const double sine = 0.5 * (growth - 1.0 / growth);
    const double cosine = 0.5 * (growth + 1.0 / growth);
    const double from_turn = orbit.side * orbit.width * sine * sine;
    const double root = ::sqrt(2.0 * (orbit.turn + orbit.lowest - from_turn));
    const double delay = 2.0 / (root * (inverse_b + root * orbit.width * sine * cosine));
    return {delay, (1.0 - 2.0 * (orbit.turn - from_turn)) * delay};
  }
};

//! The integrands of TurningDelay over dx, where v = middle + spread sinh x. The nearest
//! singularity, u = -g, is at least 0.4 away in x.
struct PlungingDelay {
  PlungingOrbit orbit;
  double inverse_b;

  ERGO_HD TwoIntegrals operator()(double x) const {
    const double growth = ::exp(x);
    const double sine = 0.5 * (growth - 1.0 / growth);
    const double cosine = 0.5 * (growth + 1.0 / growth);
    const double v = orbit.middle + orbit.spread * sine;
    const double root = ::sqrt(2.0 * (v + orbit.lowest));
    const double delay = 1.0 / (root * (inverse_b + root * orbit.spread * cosine));
    return {delay, (1.0 / 3.0 - 2.0 * v) * delay};
  }
};

}  // namespace detail

//! Returns the azimuth from the turn to `distance` = |u - turn| from it: an elliptic integral of
//! the first kind, DLMF 19.29.4 with its lower limit at a root.
ERGO_HD double swept_angle(const TurningOrbit& orbit, double distance) {
  const double at_turn = orbit.turn + orbit.lowest;
  return ::sqrt(2.0 * distance) * carlson_rf_real((at_turn - orbit.side * distance) * orbit.width,
                                                  at_turn * orbit.width, (distance + orbit.width) * at_turn);
}

//! Computes azimuth, delay and stretch (see OrbitLeg) from the turn to `distance` from it. Gauss's
//! rule is applied in a variable that makes the integrands smooth at the turn and near the critical
//! orbit.
ERGO_HD_CALLED OrbitLeg leg_from_turn(const TurningOrbit& orbit, double distance) {
  const double end = ::asinh(::sqrt(distance / orbit.width));
  const detail::TurningDelay integrand{orbit, ::sqrt(orbit.inverse_b_squared)};
  const detail::TwoIntegrals integrals = detail::gauss_16(0.0, end, 0.5, integrand);
  return {swept_angle(orbit, distance), integrals.delay, integrals.stretch};
}

//! Returns the azimuth from v = `far` to v = `near`, with `gap` = near - far > 0; DLMF 19.29.4 with
//! a complex pair of roots.
ERGO_HD_CALLED double swept_angle(const PlungingOrbit& orbit, double far, double near, double gap) {
  const Complex near_1(::sqrt(near + orbit.lowest));
  const Complex far_1(::sqrt(far + orbit.lowest));
  const Complex near_2 = sqrt(Complex(near - orbit.middle, orbit.spread));
  const Complex far_2 = sqrt(Complex(far - orbit.middle, orbit.spread));
  const Complex near_3(near_2.re, -near_2.im);
  const Complex far_3(far_2.re, -far_2.im);
  const Complex u12 = near_1 * near_2 * far_3 + far_1 * far_2 * near_3;
  const Complex u13(u12.re, -u12.im);
  const Complex u23 = near_2 * near_3 * far_1 + far_2 * far_3 * near_1;
  return ::sqrt(2.0) * gap * carlson_rf(u12 * u12, u13 * u13, u23 * u23).re;
}

//! Computes azimuth, delay and stretch (see OrbitLeg) from v = `far` to v = `near`; arguments as
//! for swept_angle().
ERGO_HD_CALLED OrbitLeg plunging_leg(const PlungingOrbit& orbit, double far, double near, double gap) {
  const double low = ::asinh((far - orbit.middle) / orbit.spread);
  const double high = ::asinh((near - orbit.middle) / orbit.spread);
  const detail::PlungingDelay integrand{orbit, ::sqrt(orbit.inverse_b_squared)};
  const detail::TwoIntegrals integrals = detail::gauss_16(low, high, 1.0, integrand);
  return {swept_angle(orbit, far, near, gap), integrals.delay, integrals.stretch};
}

}  // namespace ergodome::inline ERGO_TARGET
