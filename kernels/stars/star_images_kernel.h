#pragma once

#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"
#include "kernels/stars/star_images.h"

namespace ergodome::inline ERGO_TARGET {

//! Refines images of stars by Newton's method on traced rays. Index i covers images i * lanes to
//! (i + 1) * lanes - 1.
//!
//! A ray with its derivatives along two perpendicular directions gives the image to first order. A
//! few iterations reach the precision of the rays; the last ray's Jacobian is that of the image.
//! Usually one iteration is enough: the error that a step leaves is estimated from how much the map
//! changes along the step. The map varies on the scale of the distance to the shadow's edge. Steps
//! that are not short on that scale are made in the chart, where the lens is nearly linear.
template <class T, class Camera = CameraStationOf<ScalarOf<T>>>
struct FindStarImages {
  using D = Dual<T>;
  using S = ScalarOf<T>;

  StarImageBatch<S, Camera> batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const Vector3<T> star = load(batch.star, first);
    const T radius = load_lanes<T>(batch.radius, first, batch.count);
    const T hit_square = T(S(0.25)) * radius * radius;
    const T scale = load_lanes<T>(batch.edge_distance, first, batch.count);
    State at = {load(batch.direction, first), T(S(0)), T(S(0)), T(S(1)), T(S(1e30)), T(S(1))};
    MaskOf<T> open = T(S(0)) < T(S(1));
    for (int round = 0; round < batch.rounds && any(open); ++round) {
      const State next = step(at, star, scale, hit_square);
      at = {{select(open, next.n.x, at.n.x), select(open, next.n.y, at.n.y), select(open, next.n.z, at.n.z)},
            select(open, next.solid_angle, at.solid_angle),
            select(open, next.stretch, at.stretch),
            select(open, next.frequency_ratio, at.frequency_ratio),
            select(open, next.miss, at.miss),
            select(open, next.change, at.change)};
      // A ray that does not come from the sky will not do so in the next round either, so its
      // search ends.
      open = open & ((at.miss > T(S(batch.tolerance))) | (at.change > T(S(max_magnification_change)))) &
             (at.miss < T(S(1e29)));
    }
    const auto store = [&](S* to, const T& value) { store_lanes(to, first, batch.count, value); };
    store(batch.direction[0], at.n.x);
    store(batch.direction[1], at.n.y);
    store(batch.direction[2], at.n.z);
    store(batch.solid_angle, at.solid_angle);
    store(batch.stretch, at.stretch);
    store(batch.frequency_ratio, at.frequency_ratio);
    store(batch.miss, at.miss);
    store(batch.change, at.change);
  }

 private:
  //! Constants of the error estimates. With l the length of a step in units of the distance to the
  //! shadow's edge, and σ1 >= σ2 the singular values of the map, a step leaves a fraction of about
  //! l (max_bend σ1 + 1) / σ2 of its length as an error. The first term is for images next to the
  //! edge (an upper limit for 6,000 images about a hole of spin 0.999), the second for images next
  //! to caustics. The magnification is assumed to change by a fraction of max_changed l / min(σ2,
  //! 1) in a step. This is an upper limit for 99 % of the images; the largest factor found is 3.
  static constexpr double max_bend = 0.04;
  static constexpr double max_changed = 1.5;
  //! Factor of the damping of steps along directions that hardly change the sky; the damping is
  //! this times the square of the distance to the star. Without it, next to the shadow's edge, the
  //! first-order error across the edge would cause a much larger step along it. Values of 4 to 256
  //! find the same images.
  static constexpr double far_damping = 32.0;

  struct State {
    Vector3<T> n;
    T solid_angle;
    T stretch;
    T frequency_ratio;
    T miss;
    T change;  //!< estimated relative change of the magnification over the last step
  };

  template <class Part>
  ERGO_HD Vector3<T> load(Part* const (&from)[3], int first) const {
    return {load_lanes<T>(from[0], first, batch.count), load_lanes<T>(from[1], first, batch.count),
            load_lanes<T>(from[2], first, batch.count)};
  }

  //! Returns the direction n moved by x along e1 and y along e2. `scale`: angle from the shadow's
  //! edge [rad]; near the edge, all but short steps are made in the chart.
  ERGO_HD Vector3<T> moved(const Vector3<T>& n, const Vector3<T>& e1, const Vector3<T>& e2, const T& x, const T& y,
                           const T& scale) const {
    // Steps shorter than this fraction of `scale` are not made in the chart, because there they
    // would only add the rounding of the edge's table; far from the edge the chart brings no
    // benefit.
    constexpr double short_step = 0.05;
    constexpr double far_from_edge = 0.3;
    const Vector3<T> straight = n + x * e1 + y * e2;
    const Vector3<T> there = (T(S(1)) / sqrt(dot(straight, straight))) * straight;
    const T min_value = scale * T(S(short_step));
    const MaskOf<T> bent = (x * x + y * y > min_value * min_value) & (scale < T(S(far_from_edge)));
    if (batch.chart.chart.edge.count == 0 || !any(bent)) {
      return there;
    }
    const Vector3<T> in_chart = moved_in_chart({{n.x, e1.x, e2.x}, {n.y, e1.y, e2.y}, {n.z, e1.z, e2.z}}, x, y);
    // Next to the chart's poles γ may be NaN; such steps are made without the chart.
    const MaskOf<T> known = bent & (dot(in_chart, in_chart) < T(S(2)));
    return {select(known, in_chart.x, there.x), select(known, in_chart.y, there.y), select(known, in_chart.z, there.z)};
  }

  //! Makes the same step as moved(), but in the chart's coordinates. One of them is the logarithm
  //! of the distance to the edge, so no step crosses the edge.
  ERGO_HD Vector3<T> moved_in_chart(const Vector3<D>& n, const T& x, const T& y) const {
    constexpr double max_e_folds = 1.0;
    const LensChart& chart = batch.chart.chart;
    const AberrationOf<S>& aberration = batch.chart.aberration;
    const ChartPosition<D> position = chart_position(chart, rain_direction(aberration, n));
    const T max_value(S(max_e_folds) / S(chart.range));
    const T gamma = position.gamma_turns.value + position.gamma_turns.along_x * x + position.gamma_turns.along_y * y;
    const T step = position.s.along_x * x + position.s.along_y * y;
    const T s = minimum(position.s.value + minimum(maximum(step, -max_value), max_value), T(S(1)));
    const Vector3<MixedDual<T>> rain = chart_direction_at(chart, gamma, chart_stretch(chart, gamma, s).alpha);
    return observed_direction(aberration, Vector3<T>{rain.x.value, rain.y.value, rain.z.value});
  }

  ERGO_HD State step(const State& at, const Vector3<T>& star, const T& scale, const T& hit_square) const {
    const T zero(S(0));
    const T one(S(1));
    const Vector3<T>& n = at.n;
    // Two directions perpendicular to n.
    const auto steep = absolute(n.z) < T(S(0.9));
    const Vector3<T> axis = {select(steep, zero, one), zero, select(steep, one, zero)};
    const Vector3<T> across = cross(axis, n);
    const Vector3<T> e1 = (one / sqrt(dot(across, across))) * across;
    const Vector3<T> e2 = cross(n, e1);
    const RayStart<D> start =
        start_ray(batch.camera, Vector3<D>{{n.x, e1.x, e2.x}, {n.y, e1.y, e2.y}, {n.z, e1.z, e2.z}});
    const MaskOf<T> bright = comes_from_sky(batch.camera.spin, batch.camera.horizon_r, plain_start(start));
    MaskOf<T> reached = bright;
    T steps = zero;
    const Vector3<D> sky =
        trace_taylor<picture_order>(batch.camera.spin, start, bright, batch.settings, steps, reached).sky;
    const Vector3<T> j1 = {sky.x.along_x, sky.y.along_x, sky.z.along_x};
    const Vector3<T> j2 = {sky.x.along_y, sky.y.along_y, sky.z.along_y};
    const Vector3<T> seen = {sky.x.value, sky.y.value, sky.z.value};
    const Vector3<T> missing = star - seen;
    const Vector3<T> normal = cross(j1, j2);
    const T square = dot(normal, normal);
    const T p = dot(j1, missing);
    const T q = dot(j2, missing);
    // Levenberg-Marquardt step: Newton's step, but damped where rounding would dominate, along
    // directions that hardly change the sky.
    const T damping =
        T(S(batch.settings.tolerance * batch.settings.tolerance)) + T(S(far_damping)) * dot(missing, missing);
    const T a = dot(j1, j1) + damping;
    const T b = dot(j1, j2);
    const T c = dot(j2, j2) + damping;
    const T inverse = one / maximum(square + damping * (a + c), T(S(1e-30)));
    T x = (c * p - b * q) * inverse;
    T y = (a * q - b * p) * inverse;
    // A ray well within the star's disk needs no further step; next to a caustic, the image of the
    // disk's center may be far away.
    const auto hit = dot(missing, missing) < hit_square;
    x = select(hit, zero, x);
    y = select(hit, zero, y);
    const T length = sqrt(x * x + y * y);
    // Steps are limited to 0.1 rad, beyond which the first-order map is meaningless.
    const T part = minimum(T(S(0.1)) / maximum(length, T(S(1e-30))), one);
    // Light that hardly escapes the horizon of an extremal hole may have non-finite derivatives,
    // which yield no usable step.
    const MaskOf<T> usable = reached & (length < T(S(1e20)));
    x = select(usable, x * part, zero);
    y = select(usable, y * part, zero);
    const T side = dot(normal, seen);
    const T area = select(usable, sqrt(square), zero);
    const T stretch = select(usable, dot(j1, j1) + dot(j2, j2), zero);
    const T part_of_way = length / scale;
    const T larger = sqrt(maximum(stretch, T(S(1e-30))));
    const T smaller = maximum(area, T(S(1e-30))) / larger;
    const T left =
        minimum(part_of_way * (T(S(max_bend)) * larger + one) / smaller + damping / (smaller * smaller), one);
    const T change = minimum(T(S(max_changed)) * part_of_way / minimum(smaller, one), one);
    // An image whose step is below the tolerance cannot be improved, so its `change` is set to 0.
    const auto close = length <= T(S(batch.tolerance));
    return {moved(n, e1, e2, x, y, scale),
            select(side < zero, -area, area),
            stretch,
            one / start.energy.value,
            select(usable, length * left, T(S(1e30))),
            select(close | !usable, zero, change)};
  }
};

template <class T, class Camera, class Action>
void dispatch(const StarImageBatch<ScalarOf<T>, Camera>& batch, const Action& action) {
  action(FindStarImages<T, Camera>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
