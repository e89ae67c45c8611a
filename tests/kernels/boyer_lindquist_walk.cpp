#include "tests/kernels/boyer_lindquist_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ergodome::test {

namespace {

enum Part : std::size_t { radius, polar, radial_rate, polar_rate, azimuth, coordinate_time, part_count };
using State = std::array<double, part_count>;

//! The geodesic equations backwards in time, with Mino time as the parameter. These are Carter's
//! equations; those with square roots are differentiated once more, to second order.
class Walk {
 public:
  Walk(double spin, const NearRay<double>& ray) : a_(spin), ray_(ray), horizon_r_(1.0 + std::sqrt(1.0 - spin * spin)) {}

  [[nodiscard]] State start() const {
    const double r = 1.0 / ray_.u;
    const double sine = ray_.m.x;
    State s{};
    s[radius] = r;
    s[polar] = std::atan2(sine, ray_.m.z);
    s[radial_rate] = -ray_.u_rate * r * r;
    s[polar_rate] = sine > 0.0 ? -ray_.m_rate.z / sine : std::hypot(ray_.m_rate.x, ray_.m_rate.y);
    s[azimuth] = sine > 0.0 ? 0.0 : std::atan2(ray_.m_rate.y, ray_.m_rate.x);
    return s;
  }

  [[nodiscard]] double delta(double r) const { return (r - horizon_r_) * (r - 2.0 + horizon_r_); }

  [[nodiscard]] State after(const State& s, double h) const {
    const State k1 = rates(s);
    const State k2 = rates(moved(s, k1, 0.5 * h));
    const State k3 = rates(moved(s, k2, 0.5 * h));
    const State k4 = rates(moved(s, k3, h));
    State next = s;
    for (std::size_t i = 0; i < part_count; ++i) {
      next[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
    return next;
  }

  //! Returns a step in Mino time that is small relative to the time in which any coordinate
  //! changes.
  [[nodiscard]] double step(const State& s) const {
    const double r = s[radius];
    const double speed = std::abs(s[radial_rate]);
    const double turn = std::sqrt(std::abs(ray_.polar_constant)) + std::abs(ray_.energy) * r;
    // φ and t are singular where Δ = 0, so steps get shorter near the horizon.
    const double gap = (r - horizon_r_) * std::min(1.0, r / 4.0);
    // Shortens steps near the spin axis for a ray that misses it.
    const double sine = std::abs(std::sin(s[polar]));
    const double swing = ray_.axial_angular_momentum == 0.0 ? 1.0 : std::min(1.0, 4.0 * sine);
    return 6e-4 * std::min({swing / turn, gap / (speed + 1e-300)});
  }

 private:
  static State moved(const State& s, const State& rate, double h) {
    State to = s;
    for (std::size_t i = 0; i < part_count; ++i) {
      to[i] += h * rate[i];
    }
    return to;
  }

  [[nodiscard]] State rates(const State& s) const {
    const double e = ray_.energy;
    const double l = ray_.axial_angular_momentum;
    const double r = s[radius];
    const double d = delta(r);
    const double p = e * (r * r + a_ * a_) - a_ * l;
    const double sine = std::sin(s[polar]);
    const double cosine = std::cos(s[polar]);
    const double swirl = l == 0.0 ? 0.0 : l / (sine * sine);
    State rate{};
    rate[radius] = s[radial_rate];
    rate[polar] = s[polar_rate];
    rate[radial_rate] = 2.0 * e * r * p - (r - 1.0) * ray_.shear_constant;
    rate[polar_rate] = -a_ * a_ * e * e * cosine * sine + (l == 0.0 ? 0.0 : swirl * l * cosine / sine);
    rate[azimuth] = -(swirl + a_ * (2.0 * e * r - a_ * l) / d);
    rate[coordinate_time] = (r * r + a_ * a_) * p / d + a_ * (l - a_ * e * sine * sine);
    return rate;
  }

  double a_;
  NearRay<double> ray_;
  double horizon_r_;
};

}  // namespace

std::vector<WalkedCrossing> walk_to_shell(double spin, const NearRay<double>& ray, double shell_r, double farthest_r) {
  const Walk walk(spin, ray);
  const double horizon_r = 1.0 + std::sqrt(1.0 - spin * spin);
  std::vector<WalkedCrossing> found;
  State s = walk.start();
  double time = 0.0;
  const double innermost = horizon_r + 0.5 * (std::min(shell_r, 1.05 * horizon_r) - horizon_r);
  constexpr int step_limit = 2'000'000;
  for (int i = 0; i < step_limit; ++i) {
    const bool outwards = s[radial_rate] > 0.0;
    if ((outwards && s[radius] > farthest_r) || (!outwards && s[radius] < innermost)) {
      break;
    }
    const double h = walk.step(s);
    const State next = walk.after(s, h);
    if ((s[radius] - shell_r) * (next[radius] - shell_r) < 0.0) {
      double low = 0.0;
      double high = h;
      for (int round = 0; round < 60; ++round) {
        const double middle = 0.5 * (low + high);
        const bool before = (s[radius] - shell_r) * (walk.after(s, middle)[radius] - shell_r) > 0.0;
        (before ? low : high) = middle;
      }
      const State at = walk.after(s, low);
      found.push_back({at[polar], at[azimuth], at[coordinate_time], time + low});
    }
    s = next;
    time += h;
  }
  return found;
}

}  // namespace ergodome::test
