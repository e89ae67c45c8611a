#pragma once

#include <type_traits>

#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/trace/omni_camera.h"
#include "kernels/spacetime/trace/pixel_geometry.h"

// Traces the pixels of images.
namespace ergodome::inline ERGO_TARGET {

//! Order of the Taylor series of pictures: the cheapest at their tolerances.
inline constexpr int picture_order = 10;

//! Returns the lanes whose direction, in the frame of the edge, may touch it.
template <class T>
ERGO_HD MaskOf<T> touches_edge(const PixelBatch& batch, const Vector3<Dual<T>>& n) {
  const Vector3<float>& centre = batch.edge.centre;
  const T cosine = n.x.value * centre.x + n.y.value * centre.y + n.z.value * centre.z;
  return (cosine <= T(batch.edge_cosine_highest)) & (cosine >= T(batch.edge_cosine_lowest));
}

//! Writes the results of traced pixels.
template <class T, class Ray>
ERGO_HD void store_traced(const PixelBatch& batch, int first, const RayStart<Ray>& start, const RayEnd<Ray>& end,
                          const T& steps, const MaskOf<T>& reached, const T& lit, const MaskOf<T>& wanted) {
  using S = ScalarOf<T>;
  const T zero(S(0));
  const LensPixels& out = batch.out;
  const int count = pixel_count(batch);
  store_sky(batch, first, end.sky, reached);
  store_lanes(out.coverage, first, count, lit);
  store_lanes(out.frequency_ratio, first, count, S(1) / value_of(start.energy));
  store_lanes(out.steps, first, count, steps);
  const T unresolved = select(wanted, T(S(-1)), zero);
  store_lanes(out.error_estimate, first, count, select(reached, value_of(end.error_estimate), unresolved));
  const S a2 = batch.camera.spin * batch.camera.spin;
  const T from = value_of(start.m.z);
  const T to = value_of(end.sky.z);
  const T mean_square = S(0.5) * (from * from + to * to);
  const T sweep = safe_sqrt(value_of(start.polar_constant) + a2 * mean_square) * value_of(end.mino_time);
  store_lanes(out.half_orbits, first, count, select(reached, sweep * S(0.31830988618), zero));
}

//! Returns the pixels of a batch, which must outlive the result.
// NOLINTNEXTLINE(bugprone-return-const-ref-from-parameter): no batch is temporary
ERGO_HD const PixelBatch& pixels_of(const PixelBatch& batch) { return batch; }
ERGO_HD const PixelBatch& pixels_of(const OmniBatch& batch) { return batch.pixels; }

//! Traces the pixels of a batch: of a camera, or of an omnidirectional eye, with a camera for each
//! pixel. Index i covers the pixels i * lanes, i * lanes + 1, ... of the block. `Footprints`:
//! whether derivatives of the sky directions per pixel are computed, too.
template <class T, bool Footprints, class Batch = PixelBatch>
struct TracePixels {
  using D = Dual<T>;
  using Ray = std::conditional_t<Footprints, D, T>;
  using S = ScalarOf<T>;

  Batch batch;

  ERGO_HD void operator()(int index) const {
    const PixelBatch& pixels = pixels_of(batch);
    const int first = index * RealTraits<T>::lane_count;
    const T one(S(1));
    const T zero(S(0));
    T x_px;
    T y_px;
    pixel_middles(pixels, first, x_px, y_px);
    const T inside = image_coverage(pixels.projection, x_px, y_px);
    Vector3<D> n = observed_direction(pixels, x_px, y_px);
    T sky_lit = one;
    if (cover_lanes(pixels.edge, n, touches_edge(pixels, n), x_px, y_px, sky_lit)) {
      n = observed_direction(pixels, x_px, y_px);
    }

    const RayStart<Ray> start = start_ray(batch.camera, part_of<Ray>(n));
    const auto bright = comes_from_sky(batch.camera.spin, batch.camera.horizon_r, plain_start(start));
    // At the very edge of the shadow, a pixel that is partly lit according to the curve may be dark
    // according to its ray in float. It keeps its coverage and averages the whole sky, which is
    // what the edge shows.
    const auto dark = (!bright) & (sky_lit >= one);
    const T lit = select(dark, zero, sky_lit * inside);
    const auto wanted = bright & (lit > zero);
    T steps = zero;
    MaskOf<T> reached = wanted;
    const RayEnd<Ray> end =
        trace_taylor<picture_order>(batch.camera.spin, start, wanted, pixels.settings, steps, reached);
    store_traced<T>(pixels, first, start, end, steps, reached, lit, wanted);
  }
};

template <class T, class Batch, class Action>
requires std::is_same_v<Batch, PixelBatch> || std::is_same_v<Batch, OmniBatch>
void dispatch(const Batch& batch, const Action& action) {
  if (has_footprints(pixels_of(batch).out)) {
    action(TracePixels<T, true, Batch>{batch});
  } else {
    action(TracePixels<T, false, Batch>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
