#pragma once

#include "kernels/disk/disk_grid.h"
#include "kernels/eyes/flat/flat_horizon.h"
#include "kernels/near_field/draw_near_field.h"

// Batches that draw the near field for one eye of the stereo model `flat`.
namespace ergodome {

//! A block of rows of one eye's image in the stereo model `flat`, with disk and shells to draw over
//! it.
struct FlatEyeBatch {
  //! As seen by the head's camera, which is not omnidirectional. The time of objects is minus their
  //! nearness.
  NearFieldBatch near_field;
  Vector3<float> eye;         //!< from head to eye, in the observer's frame [M]; not 0
  float most_w;               //!< objects nearer to the eye than 1 / most_w are not drawn [1/M]
  LayerLimits<float> limits;  //!< of the disk's layers
  FlatHorizon horizon;
};

//! A block whose disk is read from a grid of the head's camera, with its nearness, and without
//! shells. Pixels that show objects are skipped.
struct FlatEyeLookUpBatch {
  FlatEyeBatch eye;
  DiskGrid grid;
  AberrationOf<float> aberration;
};

}  // namespace ergodome
