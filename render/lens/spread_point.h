#pragma once

#include <cmath>
#include <cstddef>

namespace ergodome {

struct SquarePoint {
  double x;
  double y;
};

//! The n-th of points that fill a square evenly, by multiples of the plastic number's inverse powers (Roberts' sequence; that number is the root of x³ = x + 1). They
//! stand in no rows: one along the ring of a caustic, on which next to nothing is many pixels, would stand for a whole band, and a lattice meets a ring about its
//! middle in many places at once, or in none.
inline SquarePoint spread_point(std::size_t n) {
  const auto part = [n](double step) { return std::fmod(0.5 + step * static_cast<double>(n), 1.0); };
  return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace ergodome
