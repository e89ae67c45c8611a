#pragma once

#include "kernels/core/angles.h"
#include "kernels/spacetime/geodesic/carlson.h"
#include "kernels/spacetime/kerr/ray.h"

// Polar motion in closed form. x = cosθ obeys x'² = Q + (a² - C) x² - a² x⁴, so it is an elliptic
// function of Mino time, and the azimuth is -L ∫ dλ / (1 - x²), a Legendre integral of the third
// kind. (Gralla & Lupsasca 2020, section IV; here in forms without cancellation: 1 - x² is
// expressed by L², so that rays beside the axis are accurate.)
namespace ergodome::inline ERGO_TARGET {

//! The angle η that parametrizes the polar motion: dη/dλ = √(A + B sin²η), and 1 / (1 - x²) =
//! constant + factor / (cos²η + ℓ² sin²η).
struct PolarForm {
  double a;   //!< A in dη/dλ = √(A + B sin²η) [M²]
  double b;   //!< B in dη/dλ = √(A + B sin²η) [M²]; A + B >= 0
  double l2;  //!< ℓ² in the formula of 1 / (1 - x²), in [0, 1]
  double w;   //!< w: largest x² of a motion that crosses the equator
  double constant;
  double factor;
  //! η at the camera, as sine and cosine: next to the spin axis the cosine is small and accurately
  //! known.
  double start_sine;
  double start_cosine;
};

namespace detail {

//! Computes ∫_0^η dη / √(A + B sin²η) for |η| <= π/2, from the sine and cosine of η.
ERGO_HD double first_kind(const PolarForm& p, double s, double c) {
  return s * carlson_rf(Complex(p.a * c * c), Complex(p.a + p.b * s * s), Complex(p.a)).re;
}

//! Computes ∫_0^η dη / ((cos²η + ℓ² sin²η) √(A + B sin²η)) for |η| <= π/2.
ERGO_HD double third_kind(const PolarForm& p, double s, double c) {
  const double pole = c * c + p.l2 * s * s;
  const double rj = carlson_rj(Complex(p.a * c * c), Complex(p.a + p.b * s * s), Complex(p.a), Complex(p.a * pole)).re;
  return first_kind(p, s, c) + (1.0 - p.l2) / 3.0 * s * s * s * p.a * rj;
}

//! η = π count + a remainder in [-π/2, π/2].
struct HalfTurns {
  double count;
  double sine;    //!< sine of that remainder
  double cosine;  //!< cosine of that remainder, >= 0
};

ERGO_HD HalfTurns half_turns(double eta) {
  const double count = ::rint(eta / pi);
  const double rest = eta - count * pi;
  return {count, ::sin(rest), ::fmax(0.0, ::cos(rest))};
}

ERGO_HD HalfTurns start_of(const PolarForm& p) {
  if (p.start_cosine >= 0.0) {
    return {0.0, p.start_sine, p.start_cosine};
  }
  return {p.start_sine >= 0.0 ? 1.0 : -1.0, -p.start_sine, -p.start_cosine};
}

//! Returns the η at which the integral of the first kind from 0 is `target` (the amplitude), by
//! Newton's method on the angle.
//!
//! From 0 to π/2 the integral is concave where B > 0 and convex where B < 0, so the method
//! converges monotonically from 0 or from above. If rounding or a vanishing slope leads the method
//! out of the interval that contains η, the interval is bisected instead. (Other starting points
//! oscillate where A is tiny, for light that hardly leaves the equator.)
ERGO_HD double amplitude(const PolarForm& p, double target) {
  const double half_period = 2.0 * first_kind(p, 1.0, 0.0);
  const double turns = ::rint(target / half_period);
  const double signed_rest = target - turns * half_period;
  const double rest = ::fabs(signed_rest);
  double low = 0.0;
  double high = 0.5 * pi;
  double eta = p.b > 0.0 ? 0.0 : rest / half_period * pi;
  for (int round = 0; round < 100; ++round) {
    const double s = ::sin(eta);
    const double miss = rest - first_kind(p, s, ::fmax(0.0, ::cos(eta)));
    (miss > 0.0 ? low : high) = eta;
    const double step = miss * ::sqrt(p.a + p.b * s * s);
    const double newton = eta + step;
    if (::fabs(step) <= 2e-16) {
      break;
    }
    eta = newton >= low && newton <= high ? newton : 0.5 * (low + high);
  }
  return turns * pi + (signed_rest < 0.0 ? -eta : eta);
}

//! Computes the integral of the first kind from 0 to any η.
ERGO_HD double first_kind_anywhere(const PolarForm& p, const HalfTurns& eta) {
  return (eta.count != 0.0 ? 2.0 * eta.count * first_kind(p, 1.0, 0.0) : 0.0) + first_kind(p, eta.sine, eta.cosine);
}

//! Computes L ∫ dλ / (1 - x²) from η = 0 to any η, by the integrals of the first and of the third
//! kind. On the spin axis (L = 0) only the jumps by π remain.
ERGO_HD double azimuth(const PolarForm& p, double l, const HalfTurns& eta) {
  if (l == 0.0) {
    return eta.count * 3.14159265358979323846;
  }
  const double around = p.constant * first_kind_anywhere(p, eta);
  const double whole = eta.count != 0.0 ? 2.0 * eta.count * third_kind(p, 1.0, 0.0) : 0.0;
  return l * (around + p.factor * (whole + third_kind(p, eta.sine, eta.cosine)));
}

//! Returns L, computed from the rate of the polar position. For light that moves almost only in r,
//! the L that is summed from an observer's terms agrees with that rate only to the rounding of
//! those terms.
ERGO_HD double polar_angular_momentum(const RayStart<double>& ray) { return -(ray.m.x * ray.m_rate.y); }

//! Returns Q, from C - L² or from x'² = Q + (a² - C) x² - a² x⁴ at the camera, whichever cancels
//! less; next to the equator that is the second.
ERGO_HD double polar_carter(double a2, const RayStart<double>& ray) {
  const double l = polar_angular_momentum(ray);
  const double l2 = l * l;
  const double rate2 = ray.m_rate.z * ray.m_rate.z;
  const double x2 = ray.m.z * ray.m.z;
  const double c = ray.polar_constant - a2;
  const bool by_position = rate2 + x2 * (::fabs(c) + a2 * x2) < ray.polar_constant + l2;
  return by_position ? rate2 + x2 * (c + a2 * x2) : ray.polar_constant - l2;
}

//! Describes motion through the equator, Q >= 0: x = √w sinη with w the positive root of a² w² + (C
//! - a²) w - Q.
ERGO_HD PolarForm ordinary_form(double a2, const RayStart<double>& ray, double carter) {
  const double c = ray.polar_constant - a2;
  const double root = ::sqrt(c * c + 4.0 * a2 * carter);
  PolarForm p{};
  // Keeps A above 0 for light that approaches the equator forever (Q = 0, C < a²).
  p.a = ::fmax(c >= 0.0 ? 0.5 * (c + root) : 2.0 * a2 * carter / (root - c), 1e-200);
  p.w = c >= 0.0 ? 2.0 * carter / (c + root) : 0.5 * (root - c) / a2;
  p.b = a2 * p.w;
  const double l = polar_angular_momentum(ray);
  p.l2 = ::fmin(1.0, l * l / (a2 + p.a));
  p.constant = 0.0;
  p.factor = 1.0;
  const double x = ray.m.z;
  // x = √w sinη and x' = √w cosη √(A + B sin²η).
  const double across = ray.m_rate.z / ::sqrt(p.a + a2 * x * x);
  const double length = ::hypot(x, across);
  p.start_sine = x / length;
  p.start_cosine = across / length;
  return p;
}

//! Describes motion on one side of the equator, Q < 0: x² = w1 / (1 - k² sin²η) between the roots
//! w1 and w2.
ERGO_HD PolarForm vortical_form(double a2, const RayStart<double>& ray, double carter, double& w1, double& k2) {
  const double c = a2 - ray.polar_constant;
  const double root = ::sqrt(::fmax(0.0, c * c + 4.0 * a2 * carter));
  const double w2 = 0.5 * (c + root) / a2;
  w1 = -carter / (a2 * w2);
  k2 = root / (a2 * w2);
  PolarForm p{};
  p.a = a2 * w2;
  p.b = -p.a * k2;
  const double l = polar_angular_momentum(ray);
  // (1 - w2)(1 - w1) = L² / a² gives 1 - w2 without cancellation; ℓ² = (1 - w2)(1 - k²) / (1 - w1).
  p.l2 = l * l / (a2 * (1.0 - w1)) * (1.0 - k2) / (1.0 - w1);
  p.constant = 1.0;
  p.factor = w1 / (1.0 - w1);
  const double x = ray.m.z;
  const double rate = ray.m_rate.z;
  // x'² = a² (w2 - x²)(x² - w1): the smaller factor follows from the larger.
  double above = w2 - x * x;
  double below = x * x - w1;
  if (above > below) {
    below = rate * rate / (a2 * above);
  } else if (below > 0.0) {
    above = rate * rate / (a2 * below);
  }
  const double sine = ::sqrt(::fmax(0.0, below));
  const double cosine = ::sqrt(::fmax(0.0, (1.0 - k2) * above));
  const double length = ::hypot(sine, cosine);
  // Where both roots coincide, as for a principal ray, the factors may be pure rounding, and η is
  // arbitrary.
  const bool known = length > 0.0 && length < 2.0;
  p.start_sine = known ? (x * rate < 0.0 ? -sine : sine) / length : 0.0;
  p.start_cosine = known ? cosine / length : 1.0;
  return p;
}

}  // namespace detail

namespace detail {

ERGO_HD Vector3<double> polar_position_off_axis(double spin, const RayStart<double>& ray, double time) {
  const double a2 = spin * spin;
  const double l = polar_angular_momentum(ray);
  const double carter = polar_carter(a2, ray);
  if (carter >= 0.0) {
    const PolarForm p = ordinary_form(a2, ray, carter);
    const double eta = amplitude(p, first_kind_anywhere(p, start_of(p)) + time);
    const double x = ::sqrt(p.w) * ::sin(eta);
    const double across = ::sqrt(::cos(eta) * ::cos(eta) + p.l2 * ::sin(eta) * ::sin(eta));
    const double phi = -(azimuth(p, l, half_turns(eta)) - azimuth(p, l, start_of(p)));
    return {across * ::cos(phi), across * ::sin(phi), x};
  }
  double w1 = 0.0;
  double k2 = 0.0;
  const PolarForm p = vortical_form(a2, ray, carter, w1, k2);
  const double eta = amplitude(p, first_kind_anywhere(p, start_of(p)) + time);
  const double s = ::sin(eta);
  const double c = ::cos(eta);
  const double thickness = 1.0 - k2 * s * s;
  const double x = (ray.m.z < 0.0 ? -1.0 : 1.0) * ::sqrt(w1 / thickness);
  const double across = ::sqrt((1.0 - w1) * (c * c + p.l2 * s * s) / thickness);
  const double phi = -(azimuth(p, l, half_turns(eta)) - azimuth(p, l, start_of(p)));
  return {across * ::cos(phi), across * ::sin(phi), x};
}

}  // namespace detail

//! Returns the polar position of a ray after a Mino time, without frame dragging: unit vector, φ =
//! 0 at the camera.
ERGO_HD Vector3<double> polar_position(double spin, const RayStart<double>& ray, double time) {
  const double l = ray.axial_angular_momentum;
  if (spin == 0.0 && ray.polar_constant == 0.0) {
    return ray.m;  // the ray is purely radial: the plane of its polar motion is undefined
  }
  if (ray.m.z == 0.0 && ray.m_rate.z == 0.0) {
    return {::cos(l * time), -::sin(l * time), 0.0};  // the ray stays in the equatorial plane
  }
  if (ray.m.x == 0.0) {
    // On the spin axis every ray has L = 0 and stays in the plane of its first direction, like a
    // ray that starts just beside the axis.
    const double speed = ::hypot(ray.m_rate.x, ray.m_rate.y);
    RayStart<double> beside = ray;
    beside.m_rate = {speed * ray.m.z, 0.0, -1e-300 * ray.m.z};  // already past the axis
    beside.m.x = 1e-300;
    const Vector3<double> m = detail::polar_position_off_axis(spin, beside, time);
    const double cosine = speed > 0.0 ? ray.m_rate.x / speed * ray.m.z : 1.0;
    const double sine = speed > 0.0 ? ray.m_rate.y / speed * ray.m.z : 0.0;
    return {cosine * m.x, sine * m.x, m.z};
  }
  return detail::polar_position_off_axis(spin, ray, time);
}

}  // namespace ergodome::inline ERGO_TARGET
