#pragma once

namespace ergodome {

//! How far 1/r follows the equation of motion in layers of crossings
//! (kernels/disk/crossing_layers.h), and how precisely.
template <class S>
struct LayerLimits {
  //! Ingoing light past this 1/r does not turn any more, and has passed the disk [1/M].
  S near_u;
  S far_u;      //!< outgoing light past this 1/r has left the disk behind
  S highest_u;  //!< layers are continued straight from there up to these bounds
  S lowest_u;
  S tolerance;  //!< local error
  int step_limit;
};

}  // namespace ergodome
