#pragma once

// Constants for angles in radians.
namespace ergodome {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double full_turn = 2.0 * pi;
inline constexpr double one_degree = pi / 180.0;
//! Degrees per radian.
inline constexpr double radian_deg = 180.0 / pi;

}  // namespace ergodome
