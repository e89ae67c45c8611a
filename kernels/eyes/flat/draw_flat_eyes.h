#pragma once

#include "kernels/disk/disk_grid.h"
#include "kernels/launch/kernel.h"
#include "kernels/near_field/draw_near_field.h"
#include "kernels/spacetime/shadow/flat_horizon.h"

// Batches that draw the near field for one eye of the stereo model `flat`.
namespace ergodome {

//! A block of rows of one eye's image in the stereo model `flat`, with disk and shells to draw over
//! it.
struct FlatEyeBatch {
  //! The scene as the head's camera sees it; it must not use omnidirectional stereo. The `time` of
  //! its objects is minus their nearness (1/distance from the eye).
  NearFieldBatch near_field;
  Vector3<float> eye;         //!< vector from head to eye, in the observer's frame [M]; not 0
  float max_w;                //!< objects nearer to the eye than 1 / max_w are not drawn [1/M]
  LayerLimits<float> limits;  //!< limits for tracing the disk's layers
  FlatHorizon horizon;
};

//! A block whose disk is read from a grid of the head's camera; the grid must contain `nearness`.
//! Its scene has no shells, and pixels that show objects are skipped.
struct FlatEyeLookUpBatch {
  FlatEyeBatch eye;
  DiskGrid grid;
  AberrationOf<float> aberration;
};

//! Returns the work counter's name for a variant of drawing the near field for eyes of the stereo
//! model `flat`; nullptr if there is nothing to draw.
constexpr const char* flat_eyes_name(DiskDrawing disk, bool shells) {
  constexpr const char* names[2][2] = {{nullptr, "draw_flat_eyes, shells"},
                                       {"draw_flat_eyes, disk", "draw_flat_eyes, disk, shells"}};
  return names[disk == DiskDrawing::none ? 0 : 1][shells ? 1 : 0];
}

//! Returns the work counter's name for drawing the disk from a grid, for eyes of the stereo model
//! `flat`.
constexpr const char* flat_look_up_name(DiskDrawing disk) {
  return disk == DiskDrawing::pattern ? "look_up_flat_eyes, pattern" : "look_up_flat_eyes";
}

template <>
struct Kernel<FlatEyeBatch> : KernelDefaults {
  static const char* name(const FlatEyeBatch& batch) {
    return flat_eyes_name(batch.near_field.drawing, batch.near_field.shells.count > 0);
  }
  static PixelRows rows(const FlatEyeBatch& batch) { return Kernel<NearFieldBatch>::rows(batch.near_field); }

  template <class Visit>
  static void visit_outputs(const FlatEyeBatch& batch, const Visit& visit) {
    Kernel<NearFieldBatch>::visit_outputs(batch.near_field, visit);
  }
};

template <>
struct Kernel<FlatEyeLookUpBatch> : KernelDefaults {
  static const char* name(const FlatEyeLookUpBatch& batch) { return flat_look_up_name(batch.eye.near_field.drawing); }
  static PixelRows rows(const FlatEyeLookUpBatch& batch) { return Kernel<FlatEyeBatch>::rows(batch.eye); }

  template <class Visit>
  static void visit_outputs(const FlatEyeLookUpBatch& batch, const Visit& visit) {
    Kernel<FlatEyeBatch>::visit_outputs(batch.eye, visit);
  }
};

}  // namespace ergodome
