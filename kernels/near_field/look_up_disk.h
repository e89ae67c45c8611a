#pragma once

#include "kernels/disk/disk_grid.h"
#include "kernels/near_field/draw_near_field.h"

// The batch that draws the disk from a grid.

namespace ergodome {

//! A block of rows of one image whose disk is read from a grid. Pixels of leaves that remained
//! inaccurate are traced; pixels that show objects are left unchanged.
struct DiskLookUpBatch {
  NearFieldBatch near_field;  //!< must not have shells or omnidirectional stereo
  DiskGrid grid;
  AberrationOf<float> aberration;
};

//! Returns the work counter's name for drawing the disk from a grid.
constexpr const char* disk_look_up_name(DiskDrawing disk) {
  return disk == DiskDrawing::pattern ? "look_up_disk, pattern" : "look_up_disk";
}

template <>
struct Kernel<DiskLookUpBatch> : KernelDefaults {
  static const char* name(const DiskLookUpBatch& batch) { return disk_look_up_name(batch.near_field.drawing); }
  static PixelRows rows(const DiskLookUpBatch& batch) { return Kernel<NearFieldBatch>::rows(batch.near_field); }

  template <class Visit>
  static void visit_outputs(const DiskLookUpBatch& batch, const Visit& visit) {
    Kernel<NearFieldBatch>::visit_outputs(batch.near_field, visit);
  }
};

}  // namespace ergodome
