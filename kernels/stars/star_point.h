#pragma once

#include "kernels/core/vector3.h"

namespace ergodome {

//! A point of light on the screen.
struct StarPoint {
  double x_px;
  double y_px;
  Vector3<float> light;   //!< picture value if all of it fell on one pixel; without the spikes
  Vector3<float> spikes;  //!< light of the spikes, in the same unit
  //! Part of the picture on which it is drawn: 0, or the number of a cube's face.
  int region = 0;
};

}  // namespace ergodome
