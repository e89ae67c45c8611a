#pragma once

#include <functional>
#include <vector>

#include "content/ray_table.h"

namespace ergodome {

//! Calls work(begin, end) for each run of rows with one camera; runs are bounded so that progress and Ctrl-C work. Throws Error when stopped.
void for_each_camera(const std::vector<RayRow>& rows, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ergodome
