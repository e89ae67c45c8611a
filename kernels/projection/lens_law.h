#pragma once

#include <cstdint>

#include "kernels/core/angles.h"
#include "kernels/core/arithmetic.h"

// Laws of fisheye lenses: from the angle t from the axis to the radius r in the image, in half
// widths of the image. Except for the polynomial, the radius is 1 at the rim, whose angle is h:
//   equidistant r = t / h,  equisolid r = sin(t/2) / sin(h/2),
//   stereographic r = tan(t/2) / tan(h/2),  orthographic r = sin t / sin h,
//   polynomial r = f1 t + f3 t³ + f5 t⁵ + f7 t⁷ (element `fisheye` of Christie's MPCDI extension).
namespace ergodome {

enum class LensLaw : std::int32_t { equidistant, equisolid, stereographic, orthographic, polynomial };

//! A lens: its law and its field of view.
template <class S>
struct FisheyeLens {
  LensLaw law;
  S half_angle;      //!< h: angle between the lens axis and the rim of the image [rad]
  S rim;             //!< image radius of the rim [half widths]
  S scale;           //!< sin h, sin(h/2) or tan(h/2), depending on the law
  S coefficient[4];  //!< polynomial law: coefficients of t, t³, t⁵, t⁷
};

inline namespace ERGO_TARGET {

//! Computes the radius of the polynomial law at an angle, and its slope there.
template <class T>
ERGO_HD T polynomial_radius(const FisheyeLens<ScalarOf<T>>& lens, const T& angle, T& slope) {
  using S = ScalarOf<T>;
  const S(&f)[4] = lens.coefficient;
  const T square = angle * angle;
  slope = ((S(7) * f[3] * square + S(5) * f[2]) * square + S(3) * f[1]) * square + f[0];
  return (((f[3] * square + f[2]) * square + f[1]) * square + f[0]) * angle;
}

//! Returns the angle of the polynomial law at a radius. Beyond the rim the law continues as a
//! straight line.
//!
//! Uses Newton's method, with bisection where it would leave its bounds. The last step carries the
//! derivatives of the inverse function.
template <class T>
ERGO_HD T polynomial_angle(const FisheyeLens<ScalarOf<T>>& lens, const T& radius) {
  using R = RealOf<T>;
  using S = ScalarOf<T>;
  constexpr int max_steps = sizeof(S) == 4 ? 24 : 54;
  const R close(lens.half_angle * (sizeof(S) == 4 ? S(1e-6) : S(1e-15)));
  const R target = minimum(value_of(radius), R(lens.rim));
  R low(S(0));
  R high(lens.half_angle);
  R angle = target * (lens.half_angle / lens.rim);
  R slope;
  for (int i = 0; i < max_steps; ++i) {
    const R miss = polynomial_radius(lens, angle, slope) - target;
    const auto beyond = miss > R(S(0));
    high = select(beyond, angle, high);
    low = select(beyond, low, angle);
    const R newton = angle - miss / slope;
    const R next = select((newton >= low) & (newton <= high), newton, S(0.5) * (low + high));
    const R step = absolute(next - angle);
    angle = next;
    if (!any(step > close)) {
      break;
    }
  }
  const R reached = polynomial_radius(lens, angle, slope);
  return (radius - reached) * (S(1) / slope) + angle;
}

//! Computes the sine of the angle over the radius, and the cosine of the angle, at an image
//! position, for the equidistant law.
template <class T>
ERGO_HD void look_through_plain_lens(const FisheyeLens<ScalarOf<T>>& lens, const T& x, const T& y, T& sine_over_radius,
                                     T& cosine) {
  // The term is far below the resolution of any image and prevents 0 / 0 at the center.
  const T radius = sqrt(x * x + y * y + ScalarOf<T>(1e-20));
  T sine;
  sine_cosine(lens.half_angle * radius, sine, cosine);
  sine_over_radius = sine / radius;
}

//! Computes the same as look_through_plain_lens(), for any law.
//!
//! Only the laws that need the angle itself divide by the radius; there its square is kept above 0,
//! far below the resolution of any image. The equisolid and the orthographic law end where the
//! angle is π and π/2. From 5e-8 of the radius before the end, the last ray is extended outwards,
//! so that derivatives remain finite.
template <class T>
ERGO_HD void look_through_lens(const FisheyeLens<ScalarOf<T>>& lens, const T& x, const T& y, T& sine_over_radius,
                               T& cosine) {
  using S = ScalarOf<T>;
  const T square = x * x + y * y;
  const T scaled = square * (lens.scale * lens.scale);
  if (lens.law == LensLaw::stereographic) {
    const T part = S(1) / (scaled + S(1));
    sine_over_radius = part * (S(2) * lens.scale);
    cosine = part * S(2) - S(1);
  } else if (lens.law == LensLaw::equisolid || lens.law == LensLaw::orthographic) {
    constexpr S last = S(1) - S(1e-7);
    const auto within = value_of(scaled) < RealOf<T>(last);
    const T used = scaled - maximum(value_of(scaled) - last, RealOf<T>(S(0)));
    const T drawn_in = select(within, T(S(1)), S(1) / sqrt(select(within, T(S(1)), scaled)));
    const T root = sqrt(S(1) - used);
    const bool equisolid = lens.law == LensLaw::equisolid;
    sine_over_radius = (equisolid ? root * (S(2) * lens.scale) : T(lens.scale)) * drawn_in;
    cosine = equisolid ? S(1) - used * S(2) : root;
  } else if (lens.law == LensLaw::polynomial) {
    const T radius = sqrt(square + S(1e-20));
    T sine;
    sine_cosine(polynomial_angle(lens, radius), sine, cosine);
    sine_over_radius = sine / radius;
  } else {
    look_through_plain_lens(lens, x, y, sine_over_radius, cosine);
  }
}

//! Computes the image radius of a ray from the cosine and the non-negative sine of its angle from
//! the lens axis: the inverse of look_through_lens(). Returns false where the law has no image:
//! beyond π/2 for the orthographic law, at π for the stereographic one.
ERGO_HD bool lens_radius(const FisheyeLens<double>& lens, double cosine, double sine, double& radius) {
  switch (lens.law) {
    case LensLaw::equisolid:
      radius = ::sin(0.5 * ::atan2(sine, cosine)) / lens.scale;
      return true;
    case LensLaw::stereographic:
      radius = ::tan(0.5 * ::atan2(sine, cosine)) / lens.scale;
      return cosine > -1.0 + 1e-12;
    case LensLaw::orthographic:
      radius = sine / lens.scale;
      return cosine > -1e-9;
    case LensLaw::polynomial: {
      const double angle = ::atan2(sine, cosine);
      double slope = 0.0;
      radius = polynomial_radius(lens, minimum(angle, lens.half_angle), slope);
      radius += maximum(angle - lens.half_angle, 0.0) * slope;
      return true;
    }
    case LensLaw::equidistant:
      break;
  }
  radius = ::atan2(sine, cosine) / lens.half_angle;
  return true;
}

//! Returns the largest angle from the lens axis that a law can have at the rim [rad]. For a
//! polynomial, that is the angle up to which its slope stays above a hundredth of the slope at the
//! axis; 0 if the slope at the axis is not positive.
ERGO_HD double largest_half_angle(LensLaw law, const double (&coefficient)[4]) {
  constexpr int samples = 4096;
  switch (law) {
    case LensLaw::orthographic:
      return 0.5 * pi;
    case LensLaw::stereographic:
      return pi * (1.0 - 1e-3);
    case LensLaw::polynomial:
      break;
    default:
      return pi;
  }
  FisheyeLens<double> lens{law, pi, 1.0, 1.0, {coefficient[0], coefficient[1], coefficient[2], coefficient[3]}};
  for (int i = 0; i <= samples; ++i) {
    double slope = 0.0;
    polynomial_radius(lens, pi * i / samples, slope);
    if (!(slope > 0.01 * coefficient[0])) {
      return i > 0 ? pi * (i - 1) / samples : 0.0;
    }
  }
  return pi;
}

//! Makes a lens with the given full field of view [rad]. Callers must limit it to twice
//! largest_half_angle(). `coefficient` is only used for the polynomial law.
ERGO_HD FisheyeLens<double> make_fisheye_lens(LensLaw law, double field_of_view, const double (&coefficient)[4]) {
  const double h = 0.5 * field_of_view;
  FisheyeLens<double> lens{law, h, 1.0, 1.0, {coefficient[0], coefficient[1], coefficient[2], coefficient[3]}};
  if (law == LensLaw::polynomial) {
    double slope = 0.0;
    lens.rim = polynomial_radius(lens, h, slope);
  } else {
    lens.scale = law == LensLaw::equisolid       ? ::sin(0.5 * h)
                 : law == LensLaw::stereographic ? ::tan(0.5 * h)
                 : law == LensLaw::orthographic  ? ::sin(h)
                                                 : 1.0;
  }
  return lens;
}

template <class S>
ERGO_HD FisheyeLens<S> converted_lens(const FisheyeLens<double>& lens) {
  return {lens.law,
          static_cast<S>(lens.half_angle),
          static_cast<S>(lens.rim),
          static_cast<S>(lens.scale),
          {static_cast<S>(lens.coefficient[0]), static_cast<S>(lens.coefficient[1]),
           static_cast<S>(lens.coefficient[2]), static_cast<S>(lens.coefficient[3])}};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
