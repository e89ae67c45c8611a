#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// Colors and luminances of blackbodies and stars.
namespace ergodome {

//! The colors of blackbodies as kernels read them: entries at equal steps of ln T, four floats
//! each: ln Y, X / Y, Z / Y, and padding. Y is the luminance in cd/m².
struct BlackbodyTable {
  const float* entries;
  int count;
  float first;  //!< ln T [K] of the first entry
  float step;
};

inline namespace ERGO_TARGET {

namespace detail {
//! Evaluates a lobe of Wyman, Sloan & Shirley's fit: a Gaussian with two widths.
ERGO_HD double cie_lobe(double wavelength_nm, double middle, double left, double right) {
  const double t = (wavelength_nm - middle) / (wavelength_nm < middle ? left : right);
  return ::exp(-0.5 * t * t);
}
}  // namespace detail

//! Returns the CIE 1931 2° color matching functions (analytic fit: Wyman, Sloan & Shirley, JCGT
//! 2013, eq. 4).
ERGO_HD Vector3<double> cie_matching(double wavelength_nm) {
  using detail::cie_lobe;
  const double l = wavelength_nm;
  return {1.056 * cie_lobe(l, 599.8, 37.9, 31.0) + 0.362 * cie_lobe(l, 442.0, 16.0, 26.7) -
              0.065 * cie_lobe(l, 501.1, 20.4, 26.2),
          0.821 * cie_lobe(l, 568.8, 46.9, 40.5) + 0.286 * cie_lobe(l, 530.9, 16.3, 31.1),
          1.217 * cie_lobe(l, 437.0, 11.8, 36.0) + 0.681 * cie_lobe(l, 459.0, 26.0, 13.8)};
}

//! Returns the spectral radiance of a blackbody [W / (m² sr m)], by Planck's law (CODATA 2018
//! constants).
ERGO_HD double planck_radiance(double wavelength_m, double temperature_k) {
  constexpr double first = 1.191042972397188e-16;  // 2 h c² [W m²]
  constexpr double second = 1.438776877503934e-2;  // h c / k [m K]
  const double x = second / (wavelength_m * temperature_k);
  const double l2 = wavelength_m * wavelength_m;
  return first / (l2 * l2 * wavelength_m * ::expm1(x));
}

//! Returns the tristimulus values of a blackbody; Y in cd/m². The integrand is smooth, so a sum
//! over nanometers is accurate to 1e-6 above 300 K.
ERGO_HD Vector3<double> blackbody_tristimulus(double temperature_k) {
  Vector3<double> sum = {0.0, 0.0, 0.0};
  for (int l = 360; l <= 830; ++l) {
    sum = sum + (planck_radiance(1e-9 * l, temperature_k) * 683.0 * 1e-9) * cie_matching(l);
  }
  return sum;
}

//! Returns the effective temperature of a star [K] from its color index B - V (Ballesteros, EPL 97,
//! 2012, eq. 14).
ERGO_HD double star_temperature(double b_v) { return 4600.0 * (1.0 / (0.92 * b_v + 1.7) + 1.0 / (0.92 * b_v + 0.62)); }

//! Illuminance of a star of magnitude 0 in V [lx].
inline constexpr double illuminance_of_magnitude_0 = 2.54e-6;

//! Converts tristimulus values to linear sRGB (D65; IEC 61966-2-1).
template <class T>
ERGO_HD Vector3<T> linear_srgb(const Vector3<T>& xyz) {
  return {T(3.2404542F) * xyz.x - T(1.5371385F) * xyz.y - T(0.4985314F) * xyz.z,
          T(-0.9692660F) * xyz.x + T(1.8760108F) * xyz.y + T(0.0415560F) * xyz.z,
          T(0.0556434F) * xyz.x - T(0.2040259F) * xyz.y + T(1.0572252F) * xyz.z};
}

//! Interpolates the table at ln T: ln Y, X / Y and Z / Y. Beyond the ends, the ratios stay those of
//! the ends, and ln Y is extrapolated linearly, which is the Rayleigh-Jeans law for the hottest and
//! darkness for the coldest bodies.
ERGO_HD Vector3<float> read_blackbody(const BlackbodyTable& table, float log_temperature) {
  const float position = (log_temperature - table.first) / table.step;
  const float clamped = minimum(maximum(position, 0.0F), static_cast<float>(table.count - 1));
  const int whole = static_cast<int>(clamped);
  const int i = whole < table.count - 1 ? whole : table.count - 2;
  const float* low = table.entries + 4 * i;
  const float* high = low + 4;
  const float t = clamped - static_cast<float>(i);
  const float straight = position - static_cast<float>(i);
  return {low[0] + straight * (high[0] - low[0]), low[1] + t * (high[1] - low[1]), low[2] + t * (high[2] - low[2])};
}

//! Returns light of the given luminance and color in linear sRGB; `rgb` is the color at luminance
//! 1.
//!
//! Colors redder than the display can show (blackbodies below about 1,900 K) are mixed with gray of
//! the same luminance until they fit.
ERGO_HD Vector3<float> displayable(const Vector3<float>& rgb, float luminance) {
  const float min_value = minimum(rgb.x, minimum(rgb.y, rgb.z));
  // Gray of the same luminance is 1: mix in as much as makes the smallest component 0.
  const float grey = min_value < 0.0F ? -min_value / (1.0F - min_value) : 0.0F;
  const float own = luminance * (1.0F - grey);
  return {own * rgb.x + luminance * grey, own * rgb.y + luminance * grey, own * rgb.z + luminance * grey};
}

//! Returns the light of a star as it arrives, in linear sRGB whose luminance is in the unit of
//! `flux`. A blackbody of temperature T and flux F in the V band, seen with the frequency ratio g
//! and magnified μ times, has the tristimulus values μ F XYZ(gT) / Y(T). This includes Doppler
//! shift, beaming and lensing.
ERGO_HD Vector3<float> star_light(const BlackbodyTable& table, float log_temperature, float flux, float g,
                                  float magnification) {
  const float at_rest = read_blackbody(table, log_temperature).x;
  const Vector3<float> seen = read_blackbody(table, log_temperature + ::logf(maximum(g, 1e-30F)));
  const float luminance = magnification * flux * ::expf(minimum(seen.x - at_rest, 80.0F));
  return displayable(linear_srgb(Vector3<float>{seen.y, 1.0F, seen.z}), luminance);
}

//! Returns the luminance of light in linear sRGB (the middle row of its matrix to tristimulus
//! values, IEC 61966-2-1).
template <class T>
ERGO_HD T luminance_of(const Vector3<T>& rgb) {
  return T(0.2126729F) * rgb.x + T(0.7151522F) * rgb.y + T(0.0721750F) * rgb.z;
}

//! Converts linear sRGB to tristimulus values: the inverse of linear_srgb().
template <class T>
ERGO_HD Vector3<T> tristimulus_of(const Vector3<T>& rgb) {
  return {T(0.4124564F) * rgb.x + T(0.3575761F) * rgb.y + T(0.1804375F) * rgb.z, luminance_of(rgb),
          T(0.0193339F) * rgb.x + T(0.1191920F) * rgb.y + T(0.9503041F) * rgb.z};
}

//! Shifts light in linear sRGB by the frequency ratio g. Its color is close to that of a blackbody
//! of temperature T; each of its tristimulus values changes by the factor of the blackbody's, from
//! T to gT.
//!
//! Intensity over the cube of the frequency is constant along a ray, so a blackbody remains one, of
//! temperature gT. Other light keeps its ratio to the blackbody. Tristimulus values are used
//! instead of red, green and blue because they are positive at every temperature; luminance then
//! changes exactly like the blackbody's.
ERGO_HD Vector3<float> shifted_light(const BlackbodyTable& table, const Vector3<float>& light, float log_temperature,
                                     float g) {
  const Vector3<float> xyz = tristimulus_of(light);
  if (!(xyz.y > 1e-37F)) {
    return {0.0F, 0.0F, 0.0F};
  }
  const Vector3<float> at_rest = read_blackbody(table, log_temperature);
  const Vector3<float> seen = read_blackbody(table, log_temperature + ::logf(maximum(g, 1e-30F)));
  const float luminance = xyz.y * ::expf(minimum(seen.x - at_rest.x, 80.0F));
  const Vector3<float> unit = {xyz.x / xyz.y * (seen.y / at_rest.y), 1.0F, xyz.z / xyz.y * (seen.z / at_rest.z)};
  return displayable(linear_srgb(unit), luminance);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
