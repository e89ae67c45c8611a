#pragma once

#include "kernels/core/dual.h"
#include "kernels/core/lanes.h"
#include "kernels/geodesic/taylor.h"
#include "kernels/shadow/pixel_coverage.h"
#include "kernels/trace/trace_pixels.h"

namespace ergodome::inline ERGO_TARGET {

//! Traces the pixels of a batch with their footprints; index i stands for the pixels i * lanes, i * lanes + 1, ... of the block.
template <class T>
struct TracePixels {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  static constexpr int lanes = RealTraits<T>::lane_count;
  //! Order of the Taylor series: the cheapest at the tolerances of pictures.
  static constexpr int order = 10;

  PixelBatch batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * lanes;
    const int count = batch.row_count * batch.projection.width_px;
    const T one(S(1));
    const T zero(S(0));
    T x_px;
    T y_px;
    pixel_middles(first, count, x_px, y_px);
    const T inside = image_coverage(batch.projection, x_px, y_px);
    Vector3<D> n = observed_direction(x_px, y_px);
    T sky_lit = one;
    if (look_at_edge(n, x_px, y_px, sky_lit)) {
      n = observed_direction(x_px, y_px);
    }

    const RayStart<D> start = start_ray(batch.camera, n);
    const auto bright = comes_from_sky(batch.camera.spin, batch.camera.horizon_r, plain(start));
    // In the shadow's very edge the decision in float may differ from the curve's: such a pixel keeps its coverage and looks at
    // the whole sky, which is what the edge shows.
    const auto dark = (!bright) & (sky_lit >= one);
    const T lit = select(dark, zero, sky_lit * inside);
    const auto wanted = bright & (lit > zero);
    T steps = zero;
    MaskOf<T> reached = wanted;
    const RayEnd<D> end = trace_taylor<order>(batch.camera.spin, start, wanted, batch.settings, steps, reached);
    store(first, count, start, end, steps, reached, lit, wanted);
  }

 private:
  ERGO_HD void pixel_middles(int first, int count, T& x_px, T& y_px) const {
    for (int i = 0; i < lanes; ++i) {
      const int pixel = first + i < count ? first + i : count - 1;
      const int row = pixel / batch.projection.width_px;
      set_lane(x_px, i, static_cast<S>(pixel - row * batch.projection.width_px) + S(0.5));
      set_lane(y_px, i, static_cast<S>(row + batch.first_row) + S(0.5));
    }
  }

  ERGO_HD Vector3<D> observed_direction(const T& x_px, const T& y_px) const {
    const T one(S(1));
    const T zero(S(0));
    const Vector3<D> view = direction_from_pixel(batch.projection, D(x_px, one, zero), D(y_px, zero, one));
    const auto row = [&](int i) {
      const float* m = batch.frame_from_view[i];
      return view.x * m[0] + view.y * m[1] + view.z * m[2];
    };
    return {row(0), row(1), row(2)};
  }

  ERGO_HD static Vector3<float> lane_of(const Vector3<D>& v, int i, T D::*part) {
    return {lane(v.x.*part, i), lane(v.y.*part, i), lane(v.z.*part, i)};
  }

  //! Lanes that may touch the shadow's edge get their coverage, and their position the shift into the lit part. Tells whether any
  //! was shifted.
  ERGO_HD bool look_at_edge(const Vector3<D>& n, T& x_px, T& y_px, T& lit) const {
    const Vector3<float>& centre = batch.edge.centre;
    const T cosine = n.x.value * centre.x + n.y.value * centre.y + n.z.value * centre.z;
    const auto near_edge = (cosine <= T(batch.edge_cosine_highest)) & (cosine >= T(batch.edge_cosine_lowest));
    bool shifted = false;
    if (any(near_edge)) {
      for (int i = 0; i < lanes; ++i) {
        if (mask_lane(near_edge, i)) {
          const PixelCoverage cover =
              cover_pixel(batch.edge, lane_of(n, i, &D::value), lane_of(n, i, &D::along_x), lane_of(n, i, &D::along_y));
          set_lane(lit, i, cover.lit);
          set_lane(x_px, i, lane(x_px, i) + cover.shift_x);
          set_lane(y_px, i, lane(y_px, i) + cover.shift_y);
          shifted = shifted || cover.shift_x != S(0) || cover.shift_y != S(0);
        }
      }
    }
    return shifted;
  }

  ERGO_HD static RayStart<T> plain(const RayStart<D>& s) {
    return {s.axial_angular_momentum.value,
            s.polar_constant.value,
            s.shear_constant.value,
            s.u.value,
            s.u_rate.value,
            {s.m.x.value, s.m.y.value, s.m.z.value},
            {s.m_rate.x.value, s.m_rate.y.value, s.m_rate.z.value},
            s.energy.value};
  }

  ERGO_HD void store_sky(int first, int count, const Vector3<T>& v, const MaskOf<T>& valid, const T& otherwise,
                         float* const (&to)[3]) const {
    const Vector3<T> sky = turned_to_camera(batch.camera, v);
    store_lanes(to[0], first, count, select(valid, sky.x, otherwise));
    store_lanes(to[1], first, count, select(valid, sky.y, otherwise));
    store_lanes(to[2], first, count, select(valid, sky.z, otherwise));
  }

  ERGO_HD void store(int first, int count, const RayStart<D>& start, const RayEnd<D>& end, const T& steps,
                     const MaskOf<T>& reached, const T& lit, const MaskOf<T>& wanted) const {
    const T zero(S(0));
    const LensPixels& out = batch.out;
    // A pixel without a direction has a footprint as wide as the sky.
    const T wide(S(1e3));
    store_sky(first, count, {end.sky.x.value, end.sky.y.value, end.sky.z.value}, reached, T(S(0.57735027)), out.sky);
    store_sky(first, count, {end.sky.x.along_x, end.sky.y.along_x, end.sky.z.along_x}, reached, wide, out.sky_along_x);
    store_sky(first, count, {end.sky.x.along_y, end.sky.y.along_y, end.sky.z.along_y}, reached, wide, out.sky_along_y);
    store_lanes(out.coverage, first, count, lit);
    store_lanes(out.frequency_ratio, first, count, S(1) / start.energy.value);
    store_lanes(out.steps, first, count, steps);
    const T unresolved = select(wanted, T(S(-1)), zero);
    store_lanes(out.error_estimate, first, count, select(reached, end.error_estimate.value, unresolved));
    const S a2 = batch.camera.spin * batch.camera.spin;
    const T mean_square = S(0.5) * (start.m.z.value * start.m.z.value + end.sky.z.value * end.sky.z.value);
    const T sweep = safe_sqrt(start.polar_constant.value + a2 * mean_square) * end.mino_time.value;
    store_lanes(out.half_orbits, first, count, select(reached, sweep * S(0.31830988618), zero));
  }
};

}  // namespace ergodome::inline ERGO_TARGET
