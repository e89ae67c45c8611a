#include "render/objects/lamp_guesses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/mesh/light_ray.h"

namespace ergodome {

namespace {

constexpr std::size_t most_guesses = 8;

double square_of(const Vector3<double>& v) { return dot(v, v); }

//! Corners of an outline, as far from each other as can be: each is the farthest from those before it.
std::vector<Vector3<double>> spread_corners(const std::vector<Vector3<double>>& corners) {
  std::vector<Vector3<double>> spread = {corners.front()};
  std::vector<double> apart(corners.size(), std::numeric_limits<double>::max());
  while (spread.size() < std::min(most_guesses, corners.size())) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      apart[i] = std::min(apart[i], square_of(corners[i] - spread.back()));
    }
    spread.push_back(corners[static_cast<std::size_t>(std::ranges::max_element(apart) - apart.begin())]);
  }
  return spread;
}

std::vector<Vector3<double>> places_of(const std::vector<Vector3<double>>& corners) {
  constexpr double small = 0.25;  // of the distance from the hole
  Vector3<double> middle = {0.0, 0.0, 0.0};
  for (const Vector3<double>& corner : corners) {
    middle = middle + (1.0 / static_cast<double>(corners.size())) * corner;
  }
  const bool is_small = std::ranges::all_of(corners, [&](const Vector3<double>& corner) {
    return square_of(corner - middle) < small * small * square_of(middle);
  });
  return is_small ? std::vector{middle} : spread_corners(corners);
}

LampGuess guess_at(double spin, const LampPlace& lamp, const Vector3<double>& place) {
  LampGuess guess = {place, {}};
  constexpr double beside_horizon = 1.01;
  if (square_of(place) > std::pow(beside_horizon * horizon_radius(spin), 2)) {
    const LocalFrame frame = local_frame(spin, place);
    for (int way = 0; way < 2; ++way) {
      LightRay ray{};
      light_ray(spin, frame, place, lamp.position, way + 1, LightRayParts::way, guess.corrections.by_way[way], ray);
    }
  }
  return guess;
}

}  // namespace

std::vector<LampGuess> lamp_guesses(double spin, const LampPlace& lamp, const std::vector<ObjectSettings>& objects,
                                    const std::vector<PlacedOutline>& outlines) {
  std::vector<LampGuess> guesses;
  for (std::size_t i = 0; i < objects.size() && spin != 0.0; ++i) {
    if (!objects[i].lit || outlines[i].corners.empty()) {
      continue;
    }
    for (const Vector3<double>& place : places_of(outlines[i].corners)) {
      guesses.push_back(guess_at(spin, lamp, place));
    }
  }
  return guesses;
}

}  // namespace ergodome
