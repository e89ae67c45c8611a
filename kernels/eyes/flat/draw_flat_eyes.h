#pragma once

#include "kernels/disk/disk_grid.h"
#include "kernels/eyes/flat/flat_horizon.h"
#include "kernels/near_field/draw_near_field.h"

namespace ergodome {

//! A block of rows of one eye's image in the stereo model `flat`, with disk and shells to draw over what is there.
struct FlatEyeBatch {
  NearFieldBatch near_field;  //!< by the head's camera, without eyes that turn; time of objects: minus their nearness
  Vector3<float> eye;         //!< beside the head, in the observer's frame [M]; not 0
  float most_w;               //!< nothing is nearer to the eye than 1 / most_w, or is not drawn there [1/M]
  LayerLimits<float> limits;  //!< of the disk's layers
  FlatHorizon horizon;
};

//! The same where the disk is read from a grid of the head's, with its nearness; without shells. Pixels that show objects are left out.
struct FlatEyeLookUpBatch {
  FlatEyeBatch eye;
  DiskGrid grid;
  AberrationOf<float> aberration;
};

}  // namespace ergodome
