#pragma once

namespace ergodome {

//! How far 1/r is followed on its own law for layers of crossings (kernels/disk/crossing_layers.h), and how exactly.
template <class S>
struct LayerLimits {
  S near_u;     //!< light on its way in turns no more past this 1/r, and has passed the disk [1/M]
  S far_u;      //!< light on its way out past this has left it behind
  S highest_u;  //!< layers go on straight from there to these, and no further
  S lowest_u;
  S tolerance;  //!< local error
  int step_limit;
};

}  // namespace ergodome
