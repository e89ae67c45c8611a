#pragma once

#include <glm/mat3x3.hpp>

namespace ergodome {

//! Where a camera is, but for its azimuth, which only turns the sky.
struct LensPlace {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
};

//! Whether two places differ by rounding alone, which moves an eye of a head that goes round by some last bits: what is kept of one serves the
//! other. No two places that a picture tells apart are so near, next to the horizon either.
bool same_place(const LensPlace& a, const LensPlace& b);

//! The rotation that takes the sky of a camera at one place to that of a camera at another: what moving there turns of itself. The sky
//! turns with θ, and about the axis with r, as a principal null ray does. Places may be on both sides of the horizon: within, skies are in the azimuth of ingoing
//! Kerr coordinates.
glm::dmat3 place_turn(double spin, const LensPlace& from, const LensPlace& to);

//! On what scale a camera's sky changes with r [M]: the height above the horizon, but there and within it, where nothing happens to who falls, a part of
//! that above the inner one.
double radial_measure(double spin, double r);

//! How far a place lies along the line from one to another in r and θ, in [0, 1].
double place_weight(const LensPlace& first, const LensPlace& second, const LensPlace& place);

//! How two stations with derivatives are mixed at a place: each is moved by an offset, to first order, and the second has a weight.
struct CubicMix {
  LensPlace offsets[2];
  double second_weight;
};

//! The mix that makes the cubic through values and derivatives of both, h00 A + h10 L A' + h01 B + h11 L B', as a mix by h01 of A + (h10 / h00) L A'
//! and B + (h11 / h01) L B'. What the place lies beside the line between the stations goes to both.
CubicMix cubic_mix(const LensPlace& first, const LensPlace& second, const LensPlace& place);

}  // namespace ergodome
