#include "render/passes/disk/plane_phase.h"

#include <cmath>
#include <limits>

#include "kernels/core/angles.h"
#include "kernels/disk/disk_chart.h"
#include "kernels/near_rays/near_pixels.h"

namespace ergodome {

namespace {

//! Maximum angle of the camera from the equatorial plane at which phases are used [rad]. At larger
//! angles, the band of phases is as wide as typical cells.
constexpr double widest_band = 0.3;
//! Minimum angle at which phases are used [rad]. At smaller angles, the camera is in the equatorial
//! plane up to the rounding errors of its rays (see start_near_ray()).
constexpr double narrowest_band = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

}  // namespace

PlanePhase::PlanePhase(const CameraStation& rain, const EdgeCurve& edge, double outer_r)
    : rain_(rain),
      edge_(edge),
      outer_r_(outer_r),
      matters_(std::abs(rain.cosine_theta) > narrowest_band && std::abs(rain.cosine_theta) < widest_band) {}

StartPhase PlanePhase::at(float gamma_turns, float s) const {
  if (!matters_) {
    return {0.0F, false};
  }
  const double alpha = disk_polar_angle<double>(edge_, static_cast<double>(gamma_turns), static_cast<double>(s)).value;
  const double gamma = full_turn * static_cast<double>(gamma_turns);
  const double across[2] = {std::sin(alpha) * std::cos(gamma), std::sin(alpha) * std::sin(gamma)};
  const auto component = [&](float c, float f, float h) {
    return std::cos(alpha) * static_cast<double>(c) + across[0] * static_cast<double>(f) +
           across[1] * static_cast<double>(h);
  };
  const Vector3<double> n = {component(edge_.centre.x, edge_.first.x, edge_.second.x),
                             component(edge_.centre.y, edge_.first.y, edge_.second.y),
                             component(edge_.centre.z, edge_.first.z, edge_.second.z)};
  const NearRay<double> ray = start_near_ray(rain_, n);
  const double swing = std::sqrt(std::max(ray.polar_constant, 1e-300));
  const double towards = ray.m_rate.z * (ray.m.z > 0.0 ? -1.0 : 1.0) / swing;
  return {static_cast<float>(pi - std::atan2(std::abs(ray.m.z), towards)), may_reach(rain_.spin, ray, outer_r_)};
}

}  // namespace ergodome
