#pragma once

#include "kernels/lens/look_up.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/trace/pixel_geometry.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"

// Reads pixels and rays from lens grids.
namespace ergodome::inline ERGO_TARGET {

//! Reads the pixels of a batch from a lens grid. Index i covers the pixels i * lanes, i * lanes +
//! 1, ... of the block. With `Footprints`, also computes the derivatives of the sky directions per
//! pixel; without, they cost no time.
template <class T, bool Footprints, class Batch = LookUpBatch>
struct LookUpPixels {
  using D = Dual<T>;
  using Ray = std::conditional_t<Footprints, D, T>;
  using S = ScalarOf<T>;

  Batch batch;

  ERGO_HD void operator()(int index) const { look_up(ViewedPixels<T>(batch.pixels, index)); }

  //! Reads pixels whose viewing directions are known, and traces those of flagged leaves.
  ERGO_HD void look_up(const ViewedPixels<T>& viewed) const {
    const GridValues at(batch, viewed);
    Vector3<Ray> sky = part_of<Ray>(at.read.sky);
    T steps(S(0));
    T estimate(S(0));
    const auto traced = at.wanted & at.read.flagged;
    if (any(traced)) {
      trace(part_of<Ray>(at.n), traced, sky, steps, estimate);
    }
    store(at, sky, steps, estimate);
  }

  //! Reads pixels without tracing. Calls defer(n, traced) if there are pixels of flagged leaves, with
  //! the viewing directions and the lanes that are to be traced.
  template <class Defer>
  ERGO_HD void look_up_deferring(const ViewedPixels<T>& viewed, const Defer& defer) const {
    const GridValues at(batch, viewed);
    store(at, part_of<Ray>(at.read.sky), T(S(0)), T(S(0)));
    const auto traced = at.wanted & at.read.flagged;
    if (any(traced)) {
      defer(part_of<Ray>(at.n), traced);
    }
  }

  //! Traces lanes, and returns those that arrived. The others keep their values: that of the grid is
  //! the best available in float.
  ERGO_HD MaskOf<T> trace(const Vector3<Ray>& n, const MaskOf<T>& traced, Vector3<Ray>& sky, T& steps,
                          T& estimate) const {
    const PixelBatch& pixels = batch.pixels;
    const RayStart<Ray> start = start_ray(camera_of(batch), n);
    const auto bright = traced & comes_from_sky(pixels.camera.spin, pixels.camera.horizon_r, plain_start(start));
    MaskOf<T> reached = bright;
    const RayEnd<Ray> end =
        trace_taylor<picture_order>(pixels.camera.spin, start, bright, pixels.settings, steps, reached);
    sky = {select(reached, end.sky.x, sky.x), select(reached, end.sky.y, sky.y), select(reached, end.sky.z, sky.z)};
    estimate = select(reached, value_of(end.error_estimate), estimate);
    return reached;
  }

  //! Reads pixels without tracing, for a GPU, which traces the pixels of flagged leaves separately.
  //! Returns whether there are such pixels.
  ERGO_HD bool look_up_alone(int index) const {
    const GridValues at(batch, ViewedPixels<T>(batch.pixels, index));
    store(at, part_of<Ray>(at.read.sky), T(S(0)), T(S(0)));
    return any(at.wanted & at.read.flagged);
  }

 private:
  //! Values read from the grid, for the register of pixels that one index covers.
  struct GridValues {
    int first;
    Vector3<D> n;
    T lit;
    MaskOf<T> wanted;
    GridSky<T> read;

    ERGO_HD GridValues(const Batch& batch, const ViewedPixels<T>& viewed) : first(viewed.first) {
      const PixelBatch& pixels = batch.pixels;
      const T one(S(1));
      const T zero(S(0));
      T x_px = viewed.x_px;
      T y_px = viewed.y_px;
      n = turned_from_view(pixels, viewed.view);
      Vector3<D> in_rain = rain_direction(batch.aberration, n);
      ChartPosition<D> position = chart_position(batch.lens.chart, in_rain);
      T sky_lit = select(position.edge_distance.value > zero, one, zero);
      if (cover_lanes(batch.lens.chart.edge, in_rain, near_edge(in_rain, position), x_px, y_px, sky_lit)) {
        n = observed_direction(pixels, x_px, y_px);
        in_rain = rain_direction(batch.aberration, n);
        position = chart_position(batch.lens.chart, in_rain);
      }
      lit = sky_lit * viewed.inside;
      wanted = lit > zero;
      read = read_blended(batch.lens, position, wanted);
    }
  };

  //! Returns the lanes within three pixels of the shadow's edge, on either side.
  static ERGO_HD MaskOf<T> near_edge(const Vector3<D>& n, const ChartPosition<D>& position) {
    const T square = maximum(n.x.along_x * n.x.along_x + n.y.along_x * n.y.along_x + n.z.along_x * n.z.along_x,
                             n.x.along_y * n.x.along_y + n.y.along_y * n.y.along_y + n.z.along_y * n.z.along_y);
    const T d = position.edge_distance.value;
    return d * d < square * S(9);
  }

  ERGO_HD void store(const GridValues& at, const Vector3<Ray>& sky, const T& steps, const T& estimate) const {
    const LensPixels& out = batch.pixels.out;
    const int first = at.first;
    const int count = pixel_count(batch.pixels);
    store_sky(batch.pixels, first, sky, at.wanted);
    store_lanes(out.coverage, first, count, at.lit);
    store_lanes(out.steps, first, count, steps);
    store_lanes(out.error_estimate, first, count, estimate);
    if (out.frequency_ratio != nullptr) {
      const Vector3<T> direction = {at.n.x.value, at.n.y.value, at.n.z.value};
      store_lanes(out.frequency_ratio, first, count, S(1) / energy_of(camera_of(batch), direction));
    }
  }
};

//! Reads rays from a lens grid. Index i covers the rays i * lanes, i * lanes + 1, ...
template <class T>
struct LookUpRays {
  using D = Dual<T>;
  using S = ScalarOf<T>;

  LookUpRaysBatch<S> batch;

  ERGO_HD void operator()(int index) const {
    const RayBatch<S>& rays = batch.rays;
    const int first = index * RealTraits<T>::lane_count;
    const int count = rays.count;
    const T zero(S(0));
    const Vector3<T> n = {load_lanes<T>(rays.direction[0], first, count),
                          load_lanes<T>(rays.direction[1], first, count),
                          load_lanes<T>(rays.direction[2], first, count)};
    const Vector3<T> in_rain = rain_direction(batch.aberration, n);
    const ChartPosition<D> position =
        chart_position(batch.lens.chart, Vector3<D>{D(in_rain.x), D(in_rain.y), D(in_rain.z)});
    const RayStart<T> start = start_ray(rays.camera, n);
    const auto bright = comes_from_sky(rays.camera.spin, rays.camera.horizon_r, start);
    const GridSky<T> read = read_blended(batch.lens, position, bright);
    const auto traced = bright & read.flagged;
    T steps = zero;
    MaskOf<T> reached = traced;
    RayEnd<T> end = {{zero, zero, zero}, zero, zero};
    if (any(traced)) {
      end = trace_taylor<picture_order>(rays.camera.spin, start, traced, rays.settings, steps, reached);
    }
    const Vector3<T> sky = turned_to_camera(rays.camera, Vector3<T>{select(reached, end.sky.x, read.sky.x.value),
                                                                    select(reached, end.sky.y, read.sky.y.value),
                                                                    select(reached, end.sky.z, read.sky.z.value)});
    // A ray that ran out of steps keeps the value of the grid, if there is one.
    const auto seen = bright & (dot(sky, sky) > T(S(0.5)));
    store_lanes(rays.sky[0], first, count, select(seen, sky.x, zero));
    store_lanes(rays.sky[1], first, count, select(seen, sky.y, zero));
    store_lanes(rays.sky[2], first, count, select(seen, sky.z, zero));
    store_lanes(rays.frequency_ratio, first, count, S(1) / start.energy);
    const T escaped(S(static_cast<int>(LightEnd::sky)));
    const T captured(S(static_cast<int>(LightEnd::horizon)));
    const T not_converged(S(static_cast<int>(LightEnd::unresolved)));
    store_lanes(rays.status, first, count, select(bright, select(seen, escaped, not_converged), captured));
    store_lanes(rays.steps, first, count, steps);
    store_lanes(rays.error_estimate, first, count, end.error_estimate);
    store_lanes(rays.mino_time, first, count, end.mino_time);
  }
};

template <class T, class Action>
void dispatch(const LookUpBatch& batch, const Action& action) {
  if (has_footprints(batch.pixels.out)) {
    action(LookUpPixels<T, true, LookUpBatch>{batch});
  } else {
    action(LookUpPixels<T, false, LookUpBatch>{batch});
  }
}

template <class T, class Action>
void dispatch(const OmniLookUpBatch& batch, const Action& action) {
  if (has_footprints(batch.pixels.out)) {
    action(LookUpPixels<T, true, OmniLookUpBatch>{batch});
  } else {
    action(LookUpPixels<T, false, OmniLookUpBatch>{batch});
  }
}

template <class T, class Action>
void dispatch(const LookUpRaysBatch<double>& batch, const Action& action) {
  action(LookUpRays<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
