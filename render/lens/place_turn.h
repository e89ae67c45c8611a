#pragma once

#include <glm/mat3x3.hpp>

namespace ergodome {

//! Where a camera is, but for its azimuth, which only turns the sky.
struct LensPlace {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
};

//! The rotation that takes the sky of a camera at one place to that of a camera at another: what moving there turns of itself. The sky
//! turns with θ, and about the axis with r, as a principal null ray does.
glm::dmat3 place_turn(double spin, const LensPlace& from, const LensPlace& to);

//! How far a place lies along the line from one to another in r and θ, in [0, 1].
double place_weight(const LensPlace& first, const LensPlace& second, const LensPlace& place);

}  // namespace ergodome
