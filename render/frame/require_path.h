#pragma once

#include "content/show/show.h"
#include "content/trajectory/trajectory_reader.h"

namespace ergodome {

//! Throws Error unless the trajectory was baked for the show's camera path (the same r and θ at the
//! time of each station), duration and spin. Also throws if the spin is animated.
void require_path_of(const Show& show, const TrajectoryReader& trajectory);

}  // namespace ergodome
