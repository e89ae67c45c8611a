#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/kerr/camera_station.h"

// Batches of affine distances, which place things in the head's flat tangent space.
namespace ergodome {

//! Affine distances from a camera to a radius, in many directions. Arrays have `count` elements.
struct AffineDistanceBatch {
  CameraStation camera;
  double r_end;                //!< radius of a shell or the horizon [M]
  int count;                   //!< number of directions
  const double* direction[3];  //!< unit vectors in the observer's frame (e_r, e_θ, e_φ)
  double* distance;            //!< out: as of affine_distance() [M]
};

template <>
struct Kernel<AffineDistanceBatch> : KernelDefaults {
  using Real = double;
  static constexpr int grain = grid_grain;
  static const char* name(const AffineDistanceBatch& /*batch*/) { return "trace_affine_distances"; }
  static int elements(const AffineDistanceBatch& batch) { return batch.count; }
};

}  // namespace ergodome
