#pragma once

#include "kernels/core/dual.h"
#include "kernels/core/vector3.h"

// What an eye beside the head meets along its line of sight in the head's flat tangent space (kernels/projection/flat_parallax.h).
//
// A sheet of images - one order of the disk's, one side of a shell - has an affine distance d in each direction n of the head's, and stands at d n.
// An eye at e looks along e + s m. With the nearness w = 1/s that is the head's direction m + w e, of length l(w) once it is not made a unit, at the
// distance l / w: the line meets the sheet where
//   w = l(w) q(n(w)) ,   q = 1/d ,
// from w = 0, where everything is infinitely far and n = m, up to the nearness of the eye itself. q is continuous, so such a w lies between.
namespace ergodome::inline ERGO_TARGET {

//! A place on an eye's line of sight, with derivatives along the image's rows and columns at a fixed w.
template <class T>
struct EyePoint {
  Vector3<Dual<T>> n;  //!< the head's direction
  Dual<T> length;      //!< l
  T closing;           //!< dl/dw = n · e
  T along_x;           //!< dn/dw by the derivatives of n: dn/dw = along_x ∂n/∂x + along_y ∂n/∂y
  T along_y;

  //! How something that depends on the direction alone changes with w.
  [[nodiscard]] ERGO_HD T by_nearness(const Dual<T>& f) const { return along_x * f.along_x + along_y * f.along_y; }
};

//! The line of sight of an eye in direction m (unit vectors of the observer's frame, with their derivatives per pixel).
template <class T>
struct EyeLine {
  using D = Dual<T>;
  using S = ScalarOf<T>;

  Vector3<D> m;
  Vector3<S> eye;  //!< e [M]

  //! m of a lane.
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
    // At a panorama's poles a row is one direction: what is left is found without slopes.
    const T determinant = xx * yy - xy * xy;
    const auto known = determinant > xx * yy * S(1e-6);
    const T reciprocal = select(known, S(1) / select(known, determinant, T(S(1))), T(S(0)));
    point.along_x = (gx * yy - gy * xy) * reciprocal;
    point.along_y = (gy * xx - gx * xy) * reciprocal;
    return point;
  }
};

//! Where an eye's line meets a sheet: at w + step, of which the step is so small that what depends on the place may be carried there along its
//! derivatives.
template <class T>
struct MetSheet {
  EyePoint<T> point;  //!< at w
  T w;
  T step;
  T step_along_x;  //!< how w + step changes along the image's rows and columns
  T step_along_y;
  MaskOf<T> met;  //!< lanes that have come so near

  [[nodiscard]] ERGO_HD T nearness() const { return w + step; }

  //! Carries what was found at w to where the sheet is, as the eye sees it pixel by pixel.
  [[nodiscard]] ERGO_HD Dual<T> carried(const Dual<T>& f) const {
    const T rate = point.by_nearness(f);
    return {f.value + rate * step, f.along_x + rate * step_along_x, f.along_y + rate * step_along_y};
  }

  //! The head's direction there.
  [[nodiscard]] ERGO_HD Vector3<Dual<T>> direction() const {
    return {carried(point.n.x), carried(point.n.y), carried(point.n.z)};
  }
};

//! One or the other, lane by lane.
template <class T, class Mask>
ERGO_HD MetSheet<T> chosen(const Mask& mask, const MetSheet<T>& yes, const MetSheet<T>& no) {
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

//! How a sheet is looked for.
template <class S>
struct SheetSearch {
  S most_w;     //!< nearer than that nothing is looked for [1/M]
  S precision;  //!< the last step in w may be as long [1/M]
};

//! Rounds in which a sheet is looked for: few do, but where its distance leaps.
inline constexpr int sheet_rounds = 10;

//! Finds where a line meets a sheet, from a first w. nearness(point, lanes) tells q in a direction, and keeps for its caller whatever else is seen
//! there: the last that it is asked for is the place of MetSheet. By Newton's method between bounds.
template <class T, class Nearness>
ERGO_HD MetSheet<T> meet_sheet(const EyeLine<T>& line, const T& first, const SheetSearch<ScalarOf<T>>& search,
                               const MaskOf<T>& lanes, const Nearness& nearness) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  T low(S(0));
  T high(search.most_w);
  MetSheet<T> met;
  met.w = minimum(maximum(first, low), high);
  for (int round = 0; round < sheet_rounds; ++round) {
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
    // Where bounds close on a leap, or on the nearest that is looked for, nothing is met.
    const auto before_all = before & (met.w >= T(search.most_w));
    const auto exact = (absolute(met.step) < T(search.precision)) & (absolute(miss.value) < T(S(4) * search.precision));
    met.met = lanes & exact & (!before_all);
    const auto closed = absolute(met.step) < T(S(0.01) * search.precision);
    if (!any(lanes & !(met.met | closed)) || round + 1 == sheet_rounds) {
      break;
    }
    met.w = next;
  }
  return met;
}

}  // namespace ergodome::inline ERGO_TARGET
