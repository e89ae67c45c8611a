#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/dual.h"
#include "kernels/core/vector3.h"

// The view of an eye beside the head, in the head's flat tangent space: the model of Hamilton &
// Polhemus (New Journal of Physics 12 (2010) 123027). An object seen in direction n at the affine
// distance d is at d n, and an eye at e sees it as in flat space.
//
// A layer of images (one order of the disk, or one side of a shell) has an affine distance d in
// each direction n of the head, and is at d n. An eye at e sees points e + s m. With the nearness w
// = 1/s, such a point is in the head's direction m + w e, a vector of length l(w) before
// normalization, at the distance l / w. So the line meets the layer where
//   w = l(w) q(n(w)) ,   q = 1/d ,
// between w = 0, where everything is infinitely far and n = m, and the nearness of the eye itself.
// q is continuous, so such a w exists in between.
namespace ergodome::inline ERGO_TARGET {

//! Returns the direction in which an eye at `eye` [M] sees an object that the head sees in
//! direction `n` (unit vector) at affine distance `distance` [M]. An infinite distance leaves the
//! direction unchanged. The object must not be at the eye's position.
ERGO_HD Vector3<double> seen_by_eye(const Vector3<double>& n, double distance, const Vector3<double>& eye) {
  const Vector3<double> way = n - (1.0 / distance) * eye;
  return (1.0 / ::sqrt(dot(way, way))) * way;
}

//! Returns the direction in which the head sees an object that the eye sees in direction `m`: the
//! inverse of seen_by_eye(). `distance` is the object's distance from the head [M] and must exceed
//! the eye's.
ERGO_HD Vector3<double> seen_by_head(const Vector3<double>& m, double distance, const Vector3<double>& eye) {
  // The distance s from the eye along the line of sight solves |e + s m| = d.
  const Vector3<double> e = (1.0 / distance) * eye;
  const double along = dot(e, m);
  const double way = ::sqrt(along * along + 1.0 - dot(e, e)) - along;
  return e + way * m;
}

//! A point on an eye's line of sight, with derivatives at a fixed w per pixel of the picture: along
//! x (to the right) and y (downwards).
template <class T>
struct EyePoint {
  Vector3<Dual<T>> n;  //!< direction from the head
  Dual<T> length;      //!< l: the length of m + w e, whose direction is n
  T closing;           //!< dl/dw = n · e
  //! dn/dw in terms of the derivatives of n: dn/dw = along_x ∂n/∂x + along_y ∂n/∂y.
  T along_x;
  T along_y;

  //! Returns the derivative with respect to w of a function of the direction.
  [[nodiscard]] ERGO_HD T by_nearness(const Dual<T>& f) const { return along_x * f.along_x + along_y * f.along_y; }
};

//! The line of sight of an eye in direction m (unit vectors of the observer's frame, with
//! derivatives per pixel).
template <class T>
struct EyeLine {
  using D = Dual<T>;
  using S = ScalarOf<T>;

  Vector3<D> m;
  Vector3<S> eye;  //!< e: the eye, relative to the head [M]

  //! Returns the direction m of a lane's line of sight.
  [[nodiscard]] ERGO_HD Vector3<S> direction(int i) const {
    return {lane(m.x.value, i), lane(m.y.value, i), lane(m.z.value, i)};
  }

  [[nodiscard]] ERGO_HD EyePoint<T> at(const T& w) const {
    const Vector3<D> v = {m.x + w * eye.x, m.y + w * eye.y, m.z + w * eye.z};
    EyePoint<T> point;
    point.length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    const D inverse = D(T(S(1))) / point.length;
    point.n = {v.x * inverse, v.y * inverse, v.z * inverse};
    const Vector3<T> n = {point.n.x.value, point.n.y.value, point.n.z.value};
    point.closing = n.x * eye.x + n.y * eye.y + n.z * eye.z;
    const auto rate = [&](const T& part, S of_eye) { return (T(of_eye) - part * point.closing) * inverse.value; };
    const Vector3<T> go = {rate(n.x, eye.x), rate(n.y, eye.y), rate(n.z, eye.z)};
    const Vector3<T> x = {point.n.x.along_x, point.n.y.along_x, point.n.z.along_x};
    const Vector3<T> y = {point.n.x.along_y, point.n.y.along_y, point.n.z.along_y};
    const T xx = dot(x, x);
    const T xy = dot(x, y);
    const T yy = dot(y, y);
    const T gx = dot(go, x);
    const T gy = dot(go, y);
    // At a panorama's poles a row is a single direction: `along_x` and `along_y` are then taken as
    // 0.
    const T determinant = xx * yy - xy * xy;
    const auto known = determinant > xx * yy * S(1e-6);
    const T reciprocal = select(known, S(1) / select(known, determinant, T(S(1))), T(S(0)));
    point.along_x = (gx * yy - gy * xy) * reciprocal;
    point.along_y = (gy * xx - gx * xy) * reciprocal;
    return point;
  }
};

//! The point where an eye's line of sight meets a layer: at nearness w + step. The step is so small
//! that functions of the position may be extrapolated over it by their derivatives.
template <class T>
struct MetLayer {
  EyePoint<T> point;  //!< point of the line at w
  T w;
  T step;
  T step_along_x;  //!< change of w + step per pixel to the right and downwards
  T step_along_y;
  MaskOf<T> met;  //!< lanes that meet the layer

  [[nodiscard]] ERGO_HD T nearness() const { return w + step; }

  //! Extrapolates a function from w to the layer, with derivatives per pixel of the eye.
  [[nodiscard]] ERGO_HD Dual<T> carried(const Dual<T>& f) const {
    const T rate = point.by_nearness(f);
    return {f.value + rate * step, f.along_x + rate * step_along_x, f.along_y + rate * step_along_y};
  }

  //! Returns the direction from the head to the point where the line meets the layer.
  [[nodiscard]] ERGO_HD Vector3<Dual<T>> direction() const {
    return {carried(point.n.x), carried(point.n.y), carried(point.n.z)};
  }
};

//! Selects between two results, lane by lane.
template <class T, class Mask>
ERGO_HD MetLayer<T> chosen(const Mask& mask, const MetLayer<T>& yes, const MetLayer<T>& no) {
  const auto pick = [&](const auto& a, const auto& b) { return select(mask, a, b); };
  const MaskOf<T> met = (mask & yes.met) | ((!mask) & no.met);
  return {{{pick(yes.point.n.x, no.point.n.x), pick(yes.point.n.y, no.point.n.y), pick(yes.point.n.z, no.point.n.z)},
           pick(yes.point.length, no.point.length),
           pick(yes.point.closing, no.point.closing),
           pick(yes.point.along_x, no.point.along_x),
           pick(yes.point.along_y, no.point.along_y)},
          pick(yes.w, no.w),
          pick(yes.step, no.step),
          pick(yes.step_along_x, no.step_along_x),
          pick(yes.step_along_y, no.step_along_y),
          met};
}

//! Limits of the search for the point where a line of sight meets a layer.
template <class S>
struct LayerSearch {
  S max_w;  //!< maximum w: layers nearer to the eye are not found [1/M]
  //! A layer counts as met if the last step in w is shorter than this, and w misses the layer by
  //! less than four times this [1/M].
  S precision;
};

//! Maximum number of rounds of the search. A few suffice, except where the distance jumps.
inline constexpr int layer_rounds = 10;

//! Finds where a line meets a layer, from a first guess of w, by Newton's method between bounds.
//! nearness(point, lanes) returns q in the direction of a point. Its last call is for the point of
//! the result, so other values that it stores are those of the result.
template <class T, class Nearness>
ERGO_HD MetLayer<T> meet_layer(const EyeLine<T>& line, const T& first, const LayerSearch<ScalarOf<T>>& search,
                               const MaskOf<T>& lanes, const Nearness& nearness) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  T low(S(0));
  T high(search.max_w);
  MetLayer<T> met;
  met.w = minimum(maximum(first, low), high);
  for (int round = 0; round < layer_rounds; ++round) {
    met.point = line.at(met.w);
    const D q = nearness(met.point, lanes);
    const D miss = D(met.w) - q * met.point.length;
    const T slope = S(1) - met.point.by_nearness(q) * met.point.length.value - q.value * met.point.closing;
    const auto before = miss.value < T(S(0));
    low = select(before, met.w, low);
    high = select(before, high, met.w);
    const auto rising = slope > T(S(0.05));
    const T inverse = S(1) / select(rising, slope, T(S(1)));
    const T newton = met.w - miss.value * inverse;
    const T next = select((newton >= low) & (newton <= high), newton, S(0.5) * (low + high));
    met.step = next - met.w;
    met.step_along_x = -(miss.along_x * inverse);
    met.step_along_y = -(miss.along_y * inverse);
    // If the bounds of w converge to a jump of the layer's distance, or to the maximum w, the line
    // does not meet the layer.
    const auto before_all = before & (met.w >= T(search.max_w));
    const auto exact = (absolute(met.step) < T(search.precision)) & (absolute(miss.value) < T(S(4) * search.precision));
    met.met = lanes & exact & (!before_all);
    const auto closed = absolute(met.step) < T(S(0.01) * search.precision);
    if (!any(lanes & !(met.met | closed)) || round + 1 == layer_rounds) {
      break;
    }
    met.w = next;
  }
  return met;
}

}  // namespace ergodome::inline ERGO_TARGET
