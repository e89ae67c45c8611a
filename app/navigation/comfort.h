#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ergodome {

//! Limits the length of a vector to `maximum`.
inline glm::dvec3 shortened(const glm::dvec3& v, double maximum) {
  const double length = glm::length(v);
  return length > maximum ? v * (maximum / length) : v;
}

//! Returns whether a rate [rad/s or distances/s] is at most 1e-6, too small to be visible.
inline bool at_rest(const glm::dvec3& rate) { return glm::length(rate) <= 1e-6; }

//! Moves `rate` toward `wish`, exponentially with a time constant of 0.12 s, but by at most
//! `maximum`. Returns the length of the change.
//!
//! The path is straight, so if rate and target are within a convex limit, the rate stays within it.
inline double follow(glm::dvec3& rate, const glm::dvec3& wish, double seconds, double maximum) {
  constexpr double softness_s = 0.12;
  constexpr double at_rest = 1e-7;
  const glm::dvec3 missing = wish - rate;
  const double distance = glm::length(missing);
  const double change =
      std::min(distance < at_rest ? distance : -std::expm1(-seconds / softness_s) * distance, maximum);
  if (distance > 0.0) {
    rate = change < distance ? rate + missing * (change / distance) : wish;
  }
  return change;
}

}  // namespace ergodome
