#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/lens/grid_build.h"
#include "kernels/lens/look_up.h"

namespace ergodome {

//! Points of a camera's sky at which a lens is compared with traced rays, in double.
struct BlendCheckBatch {
  GridCamera<double> camera;  //!< camera at the lens's camera position; its chart is that of the lens
  LensBlend lens;
  Aberration observer;  //!< observer for whose screen errors are measured
  double pixel;         //!< angle that a pixel of that screen subtends [rad]
  int count;
  const double* gamma_turns;
  const double* s;
  //! Error of the lens: displacement on the screen against the traced ray [px]. 0 in flagged
  //! leaves, whose pixels are traced anyway. In other leaves, 1e30 where the traced ray does not
  //! reach the sky.
  double* error_px;
  double* area_px;  //!< screen area of a chart area of one turn of γ times one unit of s [px²]
};

template <>
struct Kernel<BlendCheckBatch> : KernelDefaults {
  using Real = double;
  static constexpr int grain = grid_grain;
  static const char* name(const BlendCheckBatch& /*batch*/) { return "check_blend"; }
  static int elements(const BlendCheckBatch& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const BlendCheckBatch& batch, const Visit& visit) {
    visit("error_px", batch.error_px, batch.count);
    visit("area_px", batch.area_px, batch.count);
  }
};

}  // namespace ergodome
