#include "render/passes/sky/temperature_fit.h"

#include <cmath>

#include "kernels/sky/blackbody.h"
#include "kernels/sky/cube_map.h"

namespace ergodome {

namespace {

//! A chromaticity in the CIE 1960 uniform color space.
struct Chromaticity {
  double u;
  double v;
};

Chromaticity chromaticity(double x, double y, double z) {
  const double sum = x + 15.0 * y + 3.0 * z;
  return {4.0 * x / sum, 6.0 * y / sum};
}

}  // namespace

TemperatureFit::TemperatureFit(const BlackbodyTable& colours) : step_(colours.step) {
  const auto entry_of = [&](double temperature_k) {
    return static_cast<int>(std::lround((std::log(temperature_k) - static_cast<double>(colours.first)) /
                                        static_cast<double>(colours.step)));
  };
  const int coldest = entry_of(coldest_k);
  const int hottest = entry_of(hottest_k);
  first_ = colours.first + static_cast<float>(coldest) * colours.step;
  const auto at = [&](int entry) {
    const float* values = colours.entries + 4 * entry;
    return chromaticity(static_cast<double>(values[1]), 1.0, static_cast<double>(values[2]));
  };
  for (int entry = coldest; entry <= hottest; ++entry) {
    const Chromaticity here = at(entry);
    const Chromaticity colder = at(entry - 1);
    const Chromaticity hotter = at(entry + 1);
    const double length = std::hypot(hotter.u - colder.u, hotter.v - colder.v);
    isotherms_.push_back({here.u, here.v, (hotter.u - colder.u) / length, (hotter.v - colder.v) / length});
  }
}

float TemperatureFit::log_temperature(const glm::vec3& rgb) const {
  const Vector3<double> xyz = tristimulus_of(
      Vector3<double>{static_cast<double>(rgb.x), static_cast<double>(rgb.y), static_cast<double>(rgb.z)});
  const Chromaticity colour = chromaticity(xyz.x, xyz.y, xyz.z);
  // Returns the distance of the color from an isotherm; positive on the hotter side.
  const auto hotter_by = [&](std::size_t i) {
    const Isotherm& line = isotherms_[i];
    return (colour.u - line.u) * line.along_u + (colour.v - line.v) * line.along_v;
  };
  std::size_t low = 0;
  std::size_t high = isotherms_.size() - 1;
  if (hotter_by(low) <= 0.0) {
    return first_;
  }
  if (!(hotter_by(high) < 0.0)) {
    return first_ + static_cast<float>(high) * step_;
  }
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (hotter_by(middle) > 0.0 ? low : high) = middle;
  }
  const double below = hotter_by(low);
  const double part = below / (below - hotter_by(high));
  return first_ + static_cast<float>(static_cast<double>(low) + part) * step_;
}

float TemperatureFit::weighted_log_temperature(const glm::vec3& rgb) const {
  const float luminance = luminance_of(Vector3<float>{rgb.x, rgb.y, rgb.z});
  return luminance > 0.0F ? luminance * (log_temperature(rgb) - log_reference_temperature) : 0.0F;
}

}  // namespace ergodome
