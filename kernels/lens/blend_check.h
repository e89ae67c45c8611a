#pragma once

#include "kernels/lens/grid_build.h"
#include "kernels/lens/look_up.h"

namespace ergodome {

//! Points of a camera's sky at which a lens is compared with traced rays, in double.
struct BlendCheckBatch {
  GridCamera<double> camera;  //!< at the place; its chart is the lens's
  LensBlend lens;
  Aberration observer;  //!< whose screen counts
  double pixel;         //!< angle of a pixel on that screen [rad]
  int count;
  const double* gamma_turns;
  const double* s;
  double* error_px;  //!< displacement on the screen that a viewer sees; 0 where the lens leaves the pixel to rays
  double* area_px;   //!< area on the screen of a turn times a unit of s, by the stretch there [px²]
};

}  // namespace ergodome
