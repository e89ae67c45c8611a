#pragma once

#include <glm/mat3x3.hpp>

#include "kernels/spacetime/spacetime.h"

// Camera positions of lenses, and the rotation of the sky between them.

namespace ergodome {

//! Camera position without its azimuth, which only rotates the sky.
struct LensPlace {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
};

//! Returns whether two positions differ only by rounding, as those of an eye whose head circles the
//! axis do. Data cached for one then serves the other. Positions that look different in a frame are
//! farther apart than this, even next to the horizon.
bool same_place(const LensPlace& a, const LensPlace& b);

//! Returns the rotation that takes the sky of a camera at `from` to that of a camera at `to`. The
//! sky turns with θ and, about the axis, with r, as a principal null ray does. Positions may lie on
//! both sides of the horizon; inside it, skies are in the azimuth of ingoing Kerr coordinates.
glm::dmat3 place_turn(Spacetime spacetime, const LensPlace& from, const LensPlace& to);

//! Returns the scale on which a camera's sky changes with r [M]: the height above the horizon or,
//! near it and inside, a fraction of the height above the inner horizon (nothing special happens to
//! an infalling observer at the outer one).
double radial_measure(Spacetime spacetime, double r);

//! Returns how far a position lies along the line from `first` to `second` in r and θ, in [0, 1].
double place_weight(const LensPlace& first, const LensPlace& second, const LensPlace& place);

//! How to blend two stations with derivatives: each is moved by its offset to first order, and the
//! second has a weight.
struct CubicMix {
  LensPlace offsets[2];
  double second_weight;
};

//! Returns the blend that equals the cubic through values and derivatives of both, h00 A + h10 L A'
//! + h01 B + h11 L B': a blend with weight h01 of A + (h10 / h00) L A' and B + (h11 / h01) L B'.
//! The distance of the position from the line between the stations is added to both offsets.
CubicMix cubic_mix(const LensPlace& first, const LensPlace& second, const LensPlace& place);

}  // namespace ergodome
