#pragma once

#include <cmath>
#include <cstddef>

// Points that fill a square evenly.

namespace ergodome {

//! A point in the unit square.
struct SquarePoint {
  double x;
  double y;
};

//! Returns the n-th point of Roberts' sequence, which fills the unit square evenly: multiples of
//! the inverse powers of the plastic number (the root of x³ = x + 1). The points form no rows. A
//! lattice would be unsuitable for sampling the thin ring of a caustic: its rows would meet the
//! ring in many points at once or in none, and a point on the ring would represent a whole band.
inline SquarePoint spread_point(std::size_t n) {
  const auto part = [n](double step) { return std::fmod(0.5 + step * static_cast<double>(n), 1.0); };
  return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace ergodome
