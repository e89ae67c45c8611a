#pragma once

#include "kernels/launch/launch.h"
#include "render/lens/edge_table.h"
#include "render/lens/eye_camera.h"

namespace ergodome {

//! The exact lens: one light ray a pixel, with its footprint, and the coverage of the shadow's edge.
class DirectLens {
 public:
  //! Prepares an eye for an image. `tolerance_px` is the error of a pixel's direction on the sky, in pixels, that is accepted
  //! where the sky is neither stretched nor squeezed.
  DirectLens(Backend backend, const EyeCamera& eye, const Projection& projection, double tolerance_px);

  //! The batch that traces rows [first_row, first_row + row_count) into `out`. It refers to this object.
  [[nodiscard]] PixelBatch rows(int first_row, int row_count, const LensPixels& out) const;

 private:
  CameraStation station_;
  EdgeTable edge_;
  PixelBatch prototype_;
};

}  // namespace ergodome
