#include "content/stars/star_colour.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace ergodome {

namespace {

struct DwarfColours {
  double bp_rp;
  double b_v;
};

//! Mean colors of dwarfs of the types B9, A0, A2, A5, F0, F5, G0, G2, K0, K3, K5, M0, M2.5, M5, M8.
constexpr DwarfColours dwarf_colours[] = {{-0.120, -0.070}, {-0.037, 0.000}, {0.068, 0.070}, {0.194, 0.160},
                                          {0.377, 0.295},   {0.587, 0.440},  {0.784, 0.595}, {0.823, 0.650},
                                          {0.983, 0.816},   {1.190, 0.990},  {1.430, 1.150}, {1.840, 1.420},
                                          {2.390, 1.522},   {3.350, 1.830},  {4.860, 2.150}};

constexpr double bluest_b_v = -0.4;
constexpr double coolest_k = 1000.0;

}  // namespace

double b_v_from_bp_rp(double bp_rp) {
  // Extrapolates for stars bluer than the first type: along the line through the first two types.
  const auto* const above = std::find_if(std::next(std::begin(dwarf_colours)), std::prev(std::end(dwarf_colours)),
                                         [&](const DwarfColours& knot) { return knot.bp_rp > bp_rp; });
  const DwarfColours& from = *std::prev(above);
  const double slope = (above->b_v - from.b_v) / (above->bp_rp - from.bp_rp);
  return std::clamp(from.b_v + slope * (bp_rp - from.bp_rp), bluest_b_v, std::prev(std::end(dwarf_colours))->b_v);
}

double b_v_from_temperature(double temperature_k) {
  if (!(temperature_k >= coolest_k)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Solves t = 1 / (c + 1.7) + 1 / (c + 0.62) with c = 0.92 (B-V) for the root at which both terms
  // are positive.
  const double t = temperature_k / 4600.0;
  const double half = 0.5 * (2.32 * t - 2.0);
  const double c = (-half + std::sqrt(half * half - t * (1.054 * t - 2.32))) / t;
  return c / 0.92;
}

double v_from_gaia(double g_mag, double bp_rp) {
  if (std::isnan(bp_rp)) {
    return g_mag;
  }
  const double c = std::clamp(bp_rp, -0.5, 5.0);
  return g_mag - (-0.02704 + c * (0.01424 + c * (-0.2156 + c * 0.01426)));
}

double v_from_tycho(double bt_mag, double vt_mag) {
  return std::isnan(bt_mag) ? vt_mag : vt_mag - 0.090 * (bt_mag - vt_mag);
}

double b_v_from_tycho(double bt_mag, double vt_mag) { return 0.850 * (bt_mag - vt_mag); }

}  // namespace ergodome
