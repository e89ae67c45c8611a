#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ergodome {

//! A vector no longer than `most`.
inline glm::dvec3 shortened(const glm::dvec3& v, double most) {
  const double length = glm::length(v);
  return length > most ? v * (most / length) : v;
}

//! Whether nobody would see something go at a rate.
inline bool at_rest(const glm::dvec3& rate) { return glm::length(rate) <= 1e-6; }

//! Brings a rate towards a wish, softly, but by no more than `most`; returns the length of the change.
//!
//! The way there is the straight one: a rate and a wish that are both within a limit stay within it.
inline double follow(glm::dvec3& rate, const glm::dvec3& wish, double seconds, double most) {
  constexpr double softness_s = 0.12;
  constexpr double at_rest = 1e-7;
  const glm::dvec3 missing = wish - rate;
  const double distance = glm::length(missing);
  const double change = std::min(distance < at_rest ? distance : -std::expm1(-seconds / softness_s) * distance, most);
  if (distance > 0.0) {
    rate = change < distance ? rate + missing * (change / distance) : wish;
  }
  return change;
}

}  // namespace ergodome
