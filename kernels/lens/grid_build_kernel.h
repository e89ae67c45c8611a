#pragma once

#include "kernels/core/lanes.h"
#include "kernels/lens/grid_build.h"
#include "kernels/spacetime/geodesic/taylor.h"

// Traces the nodes of a lens grid and checks its cells.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
//! Order of the Taylor series of a grid's rays: 10 in float, for live grids; 16 in double, for fine
//! error budgets.
template <class T>
inline constexpr int grid_order = sizeof(ScalarOf<T>) == 4 ? 10 : 16;

//! Follows a ray of a grid's camera backwards and returns the sky direction that its light comes
//! from. `reached` receives the lanes whose light comes from the sky and whose ray arrived there
//! within the step limit.
template <class T, class Camera>
ERGO_HD Vector3<T> grid_sky(const GridCamera<ScalarOf<T>, Camera>& camera, const Vector3<T>& n,
                            MaskOf<RealOf<T>>& reached) {
  using Real = RealOf<T>;
  const Camera& rays = camera.rays;
  const RayStart<T> start = start_ray(rays, n);
  const auto bright = comes_from_sky(rays.spin, rays.horizon_r, plain_start(start));
  Real steps(ScalarOf<T>(0));
  return trace_taylor<grid_order<T>>(rays.spin, start, bright, camera.settings, steps, reached).sky;
}

//! Displacement of a camera direction that would explain an error of the sky direction.
template <class T>
struct Displacement {
  T length;       //!< length of the displacement as an angle [rad]
  T gamma_turns;  //!< displacement in the chart along γ [turns]; s: along s
  T s;
};

//! Returns the smallest displacement δ of a camera direction with J δ = `miss`, by the normal
//! equations. J has a column along α and one perpendicular to it, from the derivatives of the patch
//! along γ [turns] and s.
template <class T>
ERGO_HD Displacement<T> screen_displacement(const Vector3<T>& along_gamma, const Vector3<T>& along_s,
                                            const MixedDual<T>& alpha, const T& sine, const Vector3<T>& miss) {
  using S = ScalarOf<T>;
  const T per_alpha = S(1) / alpha.along_y;
  const T per_across = S(0.159154943091895335769) / maximum(sine, T(S(1e-6)));
  const Vector3<T> j1 = per_alpha * along_s;
  const Vector3<T> j2 = per_across * (along_gamma - alpha.along_x * j1);
  const T a = dot(j1, j1);
  const T b = dot(j1, j2);
  const T c = dot(j2, j2);
  const T p = dot(j1, miss);
  const T q = dot(j2, miss);
  // The determinant a c - b² equals |j1 x j2|², which is accurate even if j1 and j2 are nearly
  // parallel, so that the difference cancels.
  const Vector3<T> normal = cross(j1, j2);
  const T inverse = S(1) / (dot(normal, normal) + T(S(1e-30)));
  const T x = (c * p - b * q) * inverse;
  const T y = (a * q - b * p) * inverse;
  const T gamma_turns = per_across * y;
  return {sqrt(x * x + y * y), gamma_turns, per_alpha * (x - alpha.along_x * gamma_turns)};
}
}  // namespace detail

//! Traces the nodes of a batch with their derivatives. Index i covers the nodes i * lanes, i *
//! lanes + 1, ...
template <class T, class Camera = CameraStationOf<ScalarOf<T>>>
struct TraceNodes {
  using S = ScalarOf<T>;
  using M = MixedDual<T>;
  NodeBatch<S, Camera> batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const int first = index * lanes;
    T gamma_turns;
    T s;
    for (int i = 0; i < lanes; ++i) {
      const int node = first + i < batch.count ? first + i : batch.count - 1;
      set_lane(gamma_turns, i, S(batch.gamma_turns[node]));
      set_lane(s, i, S(batch.s[node]));
    }
    const ChartStretch<T> stretch = chart_stretch(batch.camera.chart, gamma_turns, s);
    MaskOf<T> reached;
    const Vector3<M> sky =
        detail::grid_sky(batch.camera, chart_direction_at(batch.camera.chart, gamma_turns, stretch.alpha), reached);
    // Light that barely left the horizon of an extremal hole may have non-finite derivatives; it
    // counts as not coming from the sky.
    reached = reached & (size(sky.x) + size(sky.y) + size(sky.z) < T(S(1e30)));
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      float* node = batch.nodes + floats_a_node * (first + i);
      const bool good = mask_lane(reached, i);
      store(node, sky, &M::value, i, good);
      store(node + 4, sky, &M::along_x, i, good);
      store(node + 8, sky, &M::along_y, i, good);
      store(node + 12, sky, &M::mixed, i, good);
      node[3] = good ? 1.0F : 0.0F;
    }
  }

 private:
  ERGO_HD static T size(const M& v) {
    return absolute(v.value) + absolute(v.along_x) + absolute(v.along_y) + absolute(v.mixed);
  }

  ERGO_HD static void store(float* to, const Vector3<M>& v, T M::*part, int i, bool good) {
    to[0] = good ? static_cast<float>(lane(v.x.*part, i)) : 0.0F;
    to[1] = good ? static_cast<float>(lane(v.y.*part, i)) : 0.0F;
    to[2] = good ? static_cast<float>(lane(v.z.*part, i)) : 0.0F;
    to[3] = 0.0F;
  }
};

//! Compares cells with traced rays.
//!
//! The error is the displacement that a viewer sees. With the patch's Jacobian J [per radian on the
//! screen], it is the smallest displacement δ of the camera direction for which J δ = sky of the
//! patch - traced sky.
template <class T, class Camera = CameraStationOf<ScalarOf<T>>>
struct CheckCells {
  using S = ScalarOf<T>;
  CheckBatch<S, Camera> batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const int first = index * lanes;
    T gamma_turns;
    T s;
    Patch patch;
    for (int i = 0; i < lanes; ++i) {
      const int check = first + i < batch.count ? first + i : batch.count - 1;
      read_cell(check, i, gamma_turns, s, patch);
    }
    const LensChart& chart = batch.camera.chart;
    const ChartStretch<T> stretch = chart_stretch(chart, gamma_turns, s);
    const Vector3<MixedDual<T>> n = chart_direction_at(chart, gamma_turns, stretch.alpha);
    const Vector3<T> direction = {n.x.value, n.y.value, n.z.value};
    T sine;
    T cosine;
    sine_cosine(stretch.alpha.value, sine, cosine);
    MaskOf<T> reached;
    const Vector3<T> sky = detail::grid_sky(batch.camera, direction, reached);
    const T scale = observed_scale(batch.observer, direction) * (S(1) / batch.pixel);
    const Vector3<T> miss = patch.sky - sky;
    const detail::Displacement<T> displacement =
        detail::screen_displacement(patch.along_gamma, patch.along_s, stretch.alpha, sine, miss);
    const T error = scale * displacement.length * part_without_noise(miss);
    const auto known = reached & (patch.good > T(S(0.999))) & (error < T(S(1e30)));
    const T area = S(6.28318530717958647692) * absolute(sine) * absolute(stretch.alpha.along_y) * patch.width_turns *
                   patch.height * scale * scale;
    const auto store_floats = [&](float* to, const T& value) {
      for (int i = 0; i < lanes && first + i < batch.count; ++i) {
        to[first + i] = static_cast<float>(lane(value, i));
      }
    };
    store_floats(batch.error_px, select(known, error, T(S(1e30))));
    store_floats(batch.area_px, area);
    const auto store_parts = [&](float* to, const T& parts) {
      store_floats(to, select(known, minimum(maximum(parts, T(S(-1e30))), T(S(1e30))), T(S(1e30))));
    };
    store_parts(batch.gamma_parts, displacement.gamma_turns / patch.width_turns);
    store_parts(batch.s_parts, displacement.s / patch.height);
  }

 private:
  //! Values of the patches of the lanes' cells at the checks.
  struct Patch {
    Vector3<T> sky;  //!< sky direction, a unit vector
    Vector3<T> along_gamma;
    Vector3<T> along_s;
    T good;  //!< summed weights of the corners that have a sky; below 1 if one has none
    T width_turns;
    T height;
  };

  ERGO_HD void read_cell(int check, int i, T& gamma_turns, T& s, Patch& patch) const {
    const GridCell& cell = batch.cells[check / checks_a_cell];
    const int which = check % checks_a_cell;
    const float inner = which == 0 ? inner_check : 1.0F - inner_check;
    const bool on_diagonal = which == 0 || which == 5;
    const float u = on_diagonal ? inner : (which == 3 ? 0.0F : (which == 4 ? 1.0F : 0.5F));
    const float v = on_diagonal ? inner : (which == 1 ? 0.0F : (which == 2 ? 1.0F : 0.5F));
    set_lane(gamma_turns, i, S(cell.gamma_turns + u * cell.width_turns));
    set_lane(s, i, S(cell.s + v * cell.height));
    const PatchValue value = patch_value(batch.nodes, cell.corners, u, v, cell.width_turns, cell.height);
    const float inverse = 1.0F / ::sqrtf(quad_part(value.sky, 0) * quad_part(value.sky, 0) +
                                         quad_part(value.sky, 1) * quad_part(value.sky, 1) +
                                         quad_part(value.sky, 2) * quad_part(value.sky, 2));
    const auto set = [&](Vector3<T>& to, const Quad& from) {
      set_lane(to.x, i, S(quad_part(from, 0) * inverse));
      set_lane(to.y, i, S(quad_part(from, 1) * inverse));
      set_lane(to.z, i, S(quad_part(from, 2) * inverse));
    };
    set(patch.sky, value.sky);
    set(patch.along_gamma, value.along_gamma);
    set(patch.along_s, value.along_s);
    set_lane(patch.good, i, S(quad_part(value.sky, 3)));
    set_lane(patch.width_turns, i, S(cell.width_turns));
    set_lane(patch.height, i, S(cell.height));
  }

  //! Returns the fraction of a miss that exceeds the noise of the tracing itself, which smaller
  //! cells would not reduce.
  ERGO_HD T part_without_noise(const Vector3<T>& miss) const {
    // Nodes are stored in float, even if traced in double, so the rounding is always that of float.
    constexpr S rounding = S(sizeof(S) == 4 ? 4 : 2) * S(std::numeric_limits<float>::epsilon());
    const S noise = S(2) * static_cast<S>(batch.camera.settings.tolerance) + rounding;
    const T size = sqrt(dot(miss, miss) + T(S(1e-30)));
    return maximum(size - noise, T(S(0))) / size;
  }
};

template <class T, class Camera, class Action>
void dispatch(const NodeBatch<ScalarOf<T>, Camera>& batch, const Action& action) {
  action(TraceNodes<T, Camera>{batch});
}

template <class T, class Camera, class Action>
void dispatch(const CheckBatch<ScalarOf<T>, Camera>& batch, const Action& action) {
  action(CheckCells<T, Camera>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
