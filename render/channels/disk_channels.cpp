#include "render/channels/disk_channels.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "render/channels/pixel_channels.h"

namespace ergodome {

DiskTracer::DiskTracer(const CameraStation& camera, const DiskEdges& edges)
    : camera_(camera), edges_(edges), flow_(make_disk_flow(spacetime_of(camera))) {}

std::optional<DiskCrossings> DiskTracer::trace(const Vector3<double>& n) const {
  const NearRay<double> ray = start_near_ray(camera_, n);
  // Traced back from the camera, a ray ends where it can no longer return to the disk: on its way
  // outward, beyond twice the disk's outer edge and beyond all photon orbits.
  const CrossingLimits<double> limits = {std::min(0.5 / edges_.outer, 0.22), channel_tolerance, channel_step_limit};
  EquatorialCrossing<double> crossings[crossing_orders];
  if (!trace_crossings<20, true>(camera_.spin, ray, limits, true, crossings)) {
    return std::nullopt;
  }
  const double camera_azimuth = std::atan2(camera_.sine_phi, camera_.cosine_phi);
  DiskCrossings found;
  for (std::size_t order = 0; order < found.size(); ++order) {
    const EquatorialCrossing<double>& at = crossings[order];
    const double r = at.u > 0.0 ? 1.0 / at.u : 0.0;
    if (r < edges_.inner || r > edges_.outer) {
      continue;
    }
    const DiskLight<double> light = {r, ray.energy, ray.axial_angular_momentum, ray.shear_constant, at.u_rate > 0.0};
    const double azimuth_deg =
        radian_deg * std::remainder(std::atan2(at.y, at.x) + at.drag + camera_azimuth, full_turn);
    found[order] = {r, azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg, 1.0 / disk_frequency(flow_, light),
                    at.delay};
  }
  return found;
}

}  // namespace ergodome
