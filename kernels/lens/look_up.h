#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/lens/lens_grid.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/trace/omni_camera.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Batches of pixels and rays that are read from lens grids instead of traced.
namespace ergodome {

//! A lens for one camera position: the grid of a station there, or two grids of adjacent stations.
struct LensBlend {
  LensChart chart;  //!< chart for the camera position itself
  LensGrid grids[2];
  //! Rotations from each station's sky to that of the camera position, as motion in r and θ causes
  //! them (render/lens/stations/lens_position.h).
  float turn[2][3][3];
  float second_weight;  //!< weight of the second grid; 0: only the first is used
};

inline namespace ERGO_TARGET {

//! Reads the lens at a position of its chart, for the wanted lanes: both grids at the same (γ, s),
//! rotated and mixed by the weight of the second. Flagged where either grid is.
template <class T>
ERGO_HD GridSky<T> read_blended(const LensBlend& lens, const ChartPosition<Dual<T>>& position,
                                const MaskOf<T>& wanted) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  const GridSky<T> first = read_grid(lens.grids[0], position, wanted);
  if (!(lens.second_weight > 0.0F)) {
    return first;
  }
  const GridSky<T> second = read_grid(lens.grids[1], position, wanted);
  const S w = S(lens.second_weight);
  const auto component = [&](int i) {
    const float(&p)[3] = lens.turn[0][i];
    const float(&q)[3] = lens.turn[1][i];
    const D a = first.sky.x * S(p[0]) + first.sky.y * S(p[1]) + first.sky.z * S(p[2]);
    const D b = second.sky.x * S(q[0]) + second.sky.y * S(q[1]) + second.sky.z * S(q[2]);
    return a * (S(1) - w) + b * w;
  };
  const Vector3<D> v = {component(0), component(1), component(2)};
  // Next to the edge the two directions may be arbitrary, even opposite, so their sum may be 0. The
  // small term avoids 0 / 0.
  const D inverse = D(T(S(1))) / sqrt(dot(v, v) + D(T(S(1e-12))));
  return {{v.x * inverse, v.y * inverse, v.z * inverse}, MaskOf<T>(first.flagged | second.flagged)};
}

}  // namespace ERGO_TARGET

//! A block of rows of one image, read from lens grids. The grids serve any motion of the observer:
//! `aberration` converts the observer's directions to the rain frame of the grids. Pixels of
//! flagged leaves are traced.
struct LookUpBatch {
  PixelBatch pixels;  //!< pixels to read; the batch's edge is not used, because the chart contains the edge
  LensBlend lens;
  AberrationOf<float> aberration;
};

//! A block of rows for an omnidirectional eye. Its grid is in the view's axes, and `aberration` is
//! the identity.
struct OmniLookUpBatch {
  PixelBatch pixels;
  LensBlend lens;
  AberrationOf<float> aberration;
  OmniCameraOf<float> camera;
};

inline namespace ERGO_TARGET {

//! Returns the camera by which pixels of a batch are traced.
ERGO_HD const CameraStationOf<float>& camera_of(const LookUpBatch& batch) { return batch.pixels.camera; }
ERGO_HD const OmniCameraOf<float>& camera_of(const OmniLookUpBatch& batch) { return batch.camera; }

//! Returns the energy at infinity of light that is seen in a direction, for an observed energy of
//! 1.
template <class T>
ERGO_HD T energy_of(const CameraStationOf<ScalarOf<T>>& camera, const Vector3<T>& n) {
  return detail::evaluate(camera.energy, n);
}

}  // namespace ERGO_TARGET

//! Rays of one camera, read from lens grids. Rays of flagged leaves are traced by Taylor series.
//! `rays.method` is ignored. The channels `steps`, `error_estimate` and `mino_time` are 0 for rays
//! that are read.
template <class S>
struct LookUpRaysBatch {
  RayBatch<S> rays;
  LensBlend lens;
  AberrationOf<S> aberration;
};

template <>
struct Kernel<LookUpBatch> : KernelDefaults {
  static const char* name(const LookUpBatch& batch) {
    return has_footprints(batch.pixels.out) ? "look_up_pixels, footprints" : "look_up_pixels";
  }
  static PixelRows rows(const LookUpBatch& batch) { return Kernel<PixelBatch>::rows(batch.pixels); }

  template <class Visit>
  static void visit_outputs(const LookUpBatch& batch, const Visit& visit) {
    Kernel<PixelBatch>::visit_outputs(batch.pixels, visit);
  }
};

template <>
struct Kernel<OmniLookUpBatch> : KernelDefaults {
  static const char* name(const OmniLookUpBatch& batch) {
    return has_footprints(batch.pixels.out) ? "look_up_omni_pixels, footprints" : "look_up_omni_pixels";
  }
  static PixelRows rows(const OmniLookUpBatch& batch) { return Kernel<PixelBatch>::rows(batch.pixels); }

  template <class Visit>
  static void visit_outputs(const OmniLookUpBatch& batch, const Visit& visit) {
    Kernel<PixelBatch>::visit_outputs(batch.pixels, visit);
  }
};

template <class S>
struct Kernel<LookUpRaysBatch<S>> : KernelDefaults {
  using Real = S;
  static const char* name(const LookUpRaysBatch<S>& /*batch*/) { return "look_up_rays"; }
  static int elements(const LookUpRaysBatch<S>& batch) { return batch.rays.count; }

  template <class Visit>
  static void visit_outputs(const LookUpRaysBatch<S>& batch, const Visit& visit) {
    Kernel<RayBatch<S>>::visit_outputs(batch.rays, visit);
  }
};

}  // namespace ergodome
