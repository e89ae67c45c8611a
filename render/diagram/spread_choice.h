#pragma once

#include <cstddef>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! Selects `count` positions that are far from each other, and returns their indices. The first is
//! the farthest from the mean; each further one is the farthest from all selected before. Returns
//! fewer if there are fewer distinct positions.
std::vector<std::size_t> spread_choice(const std::vector<Vector3<double>>& positions, std::size_t count);

}  // namespace ergodome
