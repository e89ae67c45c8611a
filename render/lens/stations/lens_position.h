#pragma once

#include <glm/mat3x3.hpp>

#include "kernels/spacetime/spacetime.h"

// Camera positions of lenses, and the rotation of the sky between two of them.

namespace ergodome {

//! Camera position without its azimuth, because a change of the azimuth only rotates the sky.
struct LensPosition {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
};

//! Returns whether two positions differ only by rounding, as do the positions of an eye whose head
//! circles the spin axis. Data cached for one can then be used for the other. Positions from which
//! a frame looks different are farther apart than this, even next to the horizon.
bool same_position(const LensPosition& a, const LensPosition& b);

//! Returns the rotation between the skies of cameras at two positions, from the sky seen at `from`
//! to the sky seen at `to`. The sky rotates with θ and, around the spin axis, with r, by the
//! azimuth along a principal null ray. The positions may lie on opposite sides of the horizon;
//! inside it, skies are in the azimuth of ingoing Kerr coordinates.
glm::dmat3 frame_rotation(Spacetime spacetime, const LensPosition& from, const LensPosition& to);

//! Returns the change of r over which a camera's sky changes noticeably [M]: the height above the
//! horizon or, near it and inside, a fraction of the height above the inner horizon (nothing
//! special happens to an infalling observer at the outer one).
double radial_measure(Spacetime spacetime, double r);

//! Returns the position of `position` along the line from `first` to `second` in (r, θ), as a
//! fraction in [0, 1].
double position_weight(const LensPosition& first, const LensPosition& second, const LensPosition& position);

//! How to blend two stations that have derivatives along the camera's r and θ: each is extrapolated
//! to first order by its offset, and the results are averaged with `second_weight` for the second.
struct CubicMix {
  LensPosition offsets[2];
  double second_weight;
};

//! Returns the blend that equals the cubic Hermite polynomial through the values A, B of two
//! stations and their derivatives A', B' along the line between them in (r, θ), which has the
//! length L: h00 A + h10 L A' + h01 B + h11 L B'. It is the average, with weight h01 for the
//! second, of A + (h10 / h00) L A' and B + (h11 / h01) L B'. The distance of `position` from the
//! line between the stations is added to both offsets.
CubicMix cubic_mix(const LensPosition& first, const LensPosition& second, const LensPosition& position);

}  // namespace ergodome
