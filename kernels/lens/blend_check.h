#pragma once

#include "kernels/lens/grid_build.h"
#include "kernels/lens/look_up.h"

namespace ergodome {

//! Points of a camera's sky at which a lens is compared with traced rays, in double.
struct BlendCheckBatch {
  GridCamera<double> camera;  //!< at the camera position; its chart is that of the lens
  LensBlend lens;
  Aberration observer;  //!< observer for whose screen errors are measured
  double pixel;         //!< angle of a pixel on that screen [rad]
  int count;
  const double* gamma_turns;
  const double* s;
  double* error_px;  //!< displacement on the screen; 0 for pixels that the lens leaves to rays
  double* area_px;   //!< screen area of one turn times one unit of s [px²]
};

}  // namespace ergodome
