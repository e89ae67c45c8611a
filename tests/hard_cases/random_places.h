#pragma once

#include <cstdint>
#include <string>

#include "tests/hard_cases/ray_sets.h"

// Random cameras and directions, most of them near singularities.
namespace ergodome::test {

//! Each run uses two seeds: a fixed one and a random one. ERGODOME_SWEEP_SEED=number replaces the
//! random seed, to reproduce a failure.
enum class Seed { fixed, by_chance };

//! Returns the number of a seed. The random number stays the same during a run and is printed.
std::uint64_t number_of(Seed seed);

//! Returns the factor on the limits. Limits are drawn close to the errors of the fixed seed; the
//! random seed exceeds them by half now and then, and is meant to find gross errors.
constexpr double room_of(Seed seed) { return seed == Seed::by_chance ? 100.0 : 1.0; }

//! Returns a random camera outside the horizon. Spins: from -1 to 1, a third of them 1e-1 ... 1e-9
//! from an end, and 0. Radii: from `least_height` (relative to the horizon) above it to 1e6. Polar
//! angles: over the sphere, a third of them 1e-1 ... 1e-12 from a pole, on it, or on the equator.
//! Motion: at rest in the ZAMO frame, in free fall, or at up to 0.99 c.
Place random_place(std::mt19937_64& random, double least_height);

//! Returns a random camera inside the horizon. Spins: from -0.9999 to 0.9999, and 0. Radii: down to
//! the minimum for cameras. Polar angles: as for random_place(). Motion: in free fall from rest at
//! infinity, or at up to 0.99 c relative to that.
Place random_place_within(std::mt19937_64& random);

//! Returns random rays: half over the whole sky; the rest near principal rays, near light through
//! the axis, and `nearest` ... 0.1 rad from the shadow's edge.
Directions random_rays(std::mt19937_64& random, const CameraStation& camera, int count, double nearest);

//! Describes a camera in messages of failed tests.
std::string words_of(const Place& place);

}  // namespace ergodome::test
