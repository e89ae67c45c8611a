#pragma once

#include <cstddef>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! Selects `count` positions that are far from each other, and returns their indices: each is the
//! farthest from all earlier ones. The first is the farthest from the mean. Returns fewer if no
//! more positions differ.
std::vector<std::size_t> spread_choice(const std::vector<Vector3<double>>& places, std::size_t count);

}  // namespace ergodome
