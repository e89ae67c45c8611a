#pragma once

#include <cstdint>
#include <string>

#include "tests/hard_cases/ray_sets.h"

// Random cameras and random directions, most of them near singularities.
namespace ergodome::test {

//! Each run uses two seeds: a fixed one and a random one. To reproduce a failure, the environment
//! variable ERGODOME_SWEEP_SEED=number replaces the random seed.
enum class Seed { fixed, by_chance };

//! Returns the number for a seed. The random one is printed, and stays the same during a run.
std::uint64_t number_of(Seed seed);

//! Returns the factor by which limits are multiplied. Limits are slightly larger than the errors
//! for the fixed seed; for a random seed, errors sometimes exceed them by half, and only gross
//! errors count.
constexpr double room_of(Seed seed) { return seed == Seed::by_chance ? 100.0 : 1.0; }

//! Returns a random camera outside the horizon. Spin: from -1 to 1; a third of the values are
//! within 1e-1 ... 1e-9 of -1 or 1, or are 0. Radius: from `min_height` (relative to the horizon
//! radius) above the horizon to 1e6. Polar angle: anywhere; a third of the values are within 1e-1
//! ... 1e-12 of a pole, on it, or on the equator. Motion: at rest in the ZAMO frame, in free fall,
//! or at up to 0.99 c.
CameraState random_position(std::mt19937_64& random, double min_height);

//! Returns a random camera inside the horizon. Spin: from -0.9999 to 0.9999, and 0. Radius: down to
//! the minimum for cameras. Polar angle: as in random_position(). Motion: at rest in the rain
//! frame, or at up to 0.99 c relative to it.
CameraState random_position_within(std::mt19937_64& random);

//! Returns random rays. Half of them are anywhere on the sky. The others are near principal null
//! directions, near light that crosses the spin axis, or between `nearest` and 0.1 rad from the
//! edge of the shadow.
Directions random_rays(std::mt19937_64& random, const CameraStation& camera, int count, double nearest);

//! Describes a camera in messages of failed tests.
std::string words_of(const CameraState& camera_state);

}  // namespace ergodome::test
