#pragma once

#include "kernels/core/vector3.h"

namespace ergodome {

//! Light on the screen, at a point.
struct StarPoint {
  double x_px;
  double y_px;
  Vector3<float> light;   //!< picture value times pixels
  Vector3<float> spikes;  //!< light of the spikes, of the same measure
  int sheet = 0;          //!< of the picture, on which it is drawn: the only one, or a cube's face
};

}  // namespace ergodome
