#pragma once

#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/lens/lens_grid.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

namespace ergodome {

//! A lens for one place of the camera: the grid of a station there, or two of stations to both sides.
struct LensBlend {
  LensChart chart;  //!< of the place itself
  LensGrid grids[2];
  float turn[2][3][3];  //!< from each station's sky to that of the place: what moving there turns of itself
  float second_weight;  //!< 0: the first grid alone, and the second is not looked at
};

inline namespace ERGO_TARGET {

//! Reads the lens at a place of its chart, for the lanes that are wanted: both grids at the same (γ, s), turned, and mixed by the
//! weight of the second. Flagged where either is.
template <class T>
ERGO_HD GridSky<T> read_blended(const LensBlend& lens, const ChartPlace<Dual<T>>& place, const MaskOf<T>& wanted) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  const GridSky<T> first = read_grid(lens.grids[0], place, wanted);
  if (!(lens.second_weight > 0.0F)) {
    return first;
  }
  const GridSky<T> second = read_grid(lens.grids[1], place, wanted);
  const S w = S(lens.second_weight);
  const auto component = [&](int i) {
    const float(&p)[3] = lens.turn[0][i];
    const float(&q)[3] = lens.turn[1][i];
    const D a = first.sky.x * S(p[0]) + first.sky.y * S(p[1]) + first.sky.z * S(p[2]);
    const D b = second.sky.x * S(q[0]) + second.sky.y * S(q[1]) + second.sky.z * S(q[2]);
    return a * (S(1) - w) + b * w;
  };
  const Vector3<D> v = {component(0), component(1), component(2)};
  // Next to the edge the two may point anywhere, even away from each other.
  const D inverse = D(T(S(1))) / sqrt(dot(v, v) + D(T(S(1e-12))));
  return {{v.x * inverse, v.y * inverse, v.z * inverse}, MaskOf<T>(first.flagged | second.flagged)};
}

}  // namespace ERGO_TARGET

//! A block of rows of one image, read from lens grids. They serve any motion of the observer: `aberration` leads to their rain frame.
//! Pixels of leaves that could not be made good are traced.
struct LookUpBatch {
  PixelBatch pixels;  //!< its edge is not used: the chart has the edge
  LensBlend lens;
  AberrationOf<float> aberration;
};

//! The same block of two eyes' images, which have one projection.
struct LookUpPairBatch {
  LookUpBatch eyes[2];
};

//! The same for an eye that turns with the direction: its grid lies in the view's axes, and `aberration` changes nothing.
struct OmniLookUpBatch {
  PixelBatch pixels;
  LensBlend lens;
  AberrationOf<float> aberration;
  OmniCameraOf<float> camera;
};

inline namespace ERGO_TARGET {

//! What pixels of a batch are traced by, where they are.
ERGO_HD const CameraStationOf<float>& camera_of(const LookUpBatch& batch) { return batch.pixels.camera; }
ERGO_HD const OmniCameraOf<float>& camera_of(const OmniLookUpBatch& batch) { return batch.camera; }

//! The energy at infinity of light that is seen in a direction, for an observed energy of 1.
template <class T>
ERGO_HD T energy_of(const CameraStationOf<ScalarOf<T>>& camera, const Vector3<T>& n) {
  return detail::evaluate(camera.energy, n);
}

}  // namespace ERGO_TARGET

//! Rays of one camera, read from lens grids; `rays.method` and the channels `steps`, `error_estimate` and `mino_time` speak of the
//! rays that are traced (steps 0: read from the grid).
template <class S>
struct LookUpRaysBatch {
  RayBatch<S> rays;
  LensBlend lens;
  AberrationOf<S> aberration;
};

}  // namespace ergodome
