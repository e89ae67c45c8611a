#pragma once

#include "content/show/show.h"
#include "content/trajectory/trajectory_reader.h"

namespace ergodome {

//! Throws Error unless the trajectory was baked along the camera path of the show, and for the
//! show's hole.
void require_path_of(const Show& show, const TrajectoryReader& trajectory);

}  // namespace ergodome
