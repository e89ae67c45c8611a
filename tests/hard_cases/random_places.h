#pragma once

#include <cstdint>
#include <string>

#include "tests/hard_cases/ray_sets.h"

// Cameras and directions by chance, most of them where something is singular.
namespace ergodome::test {

//! Two seeds a run: one that is always the same, and one that never is, but for
//! ERGODOME_SWEEP_SEED=number, which is how a failure that chance has found is found again.
enum class Seed { fixed, by_chance };

//! The number of a seed; the one by chance is the same through a run, and printed.
std::uint64_t number_of(Seed seed);

//! What limits are multiplied by. The fixed seed's are drawn close to what is; chance goes beyond
//! them by half now and then, and looks for what is wrong.
constexpr double room_of(Seed seed) { return seed == Seed::by_chance ? 100.0 : 1.0; }

//! Spins from -1 to 1, a third of them 1e-1 ... 1e-9 from an end, and 0; radii from `least_height`
//! of the horizon's above it to 1e6; polar angles over the sphere, a third of them 1e-1 ... 1e-12
//! from a pole, on it, or on the equator; at rest in the ZAMO frame, in free fall, or at up to 0.99
//! c.
Place random_place(std::mt19937_64& random, double least_height);

//! Within the horizon: spins to ±0.9999 and 0, radii down to the least that cameras may have, polar
//! angles as above; in free fall from rest far away, or at up to 0.99 c past that.
Place random_place_within(std::mt19937_64& random);

//! Half over the whole sky; the rest about principal rays, light through the axis, and `nearest`
//! ... 0.1 rad from the shadow's edge.
Directions random_rays(std::mt19937_64& random, const CameraStation& camera, int count, double nearest);

//! What is written beside a failure.
std::string words_of(const Place& place);

}  // namespace ergodome::test
