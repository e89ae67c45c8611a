#pragma once

#include <cstddef>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! Which of some places to take, so that `count` of them are as far from each other as may be: each next one is farthest from all before it. The
//! first is the one farthest from their middle. Fewer, where no more of them differ.
std::vector<std::size_t> spread_choice(const std::vector<Vector3<double>>& places, std::size_t count);

}  // namespace ergodome
