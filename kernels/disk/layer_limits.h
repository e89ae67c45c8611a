#pragma once

namespace ergodome {

//! Range of 1/r in which rays follow the equation of motion for layers of crossings
//! (kernels/disk/crossing_layers.h), and the precision of their steps.
template <class S>
struct LayerLimits {
  //! Ingoing light beyond this 1/r cannot turn any more, and has passed the disk's inner edge
  //! [1/M]. Its 1/r is continued straight from there.
  S near_u;
  //! Outgoing light below this 1/r is outside the disk, and its 1/r is continued straight from
  //! there as well.
  S far_u;
  S highest_u;  //!< straight continuations of layers end at u = highest_u or at u = lowest_u
  S lowest_u;
  S tolerance;  //!< maximum local error of a step, as an angle [rad]
  int step_limit;
};

}  // namespace ergodome
