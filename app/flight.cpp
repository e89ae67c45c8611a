#include "app/flight.h"

#include <algorithm>
#include <cmath>

#include "kernels/metric/kerr.h"

namespace ergodome {

double least_radius(const Show& show) {
  const double horizon = horizon_radius(show.spin);
  switch (show.camera.motion) {
    case ObserverMotion::fixed:
      return 2.02;  // the ergosphere ends at 2 in the equator, further in elsewhere
    case ObserverMotion::geodesic:
      return 1.01 * photon_orbit_radius(show.spin, 1.0);
    case ObserverMotion::retrograde:
      return 1.01 * photon_orbit_radius(show.spin, -1.0);
    default:
      return horizon + 0.02;
  }
}

void Flight::look(double right, double up) {
  const glm::dquat yaw = glm::angleAxis(-right, glm::dvec3(0.0, 1.0, 0.0));
  const glm::dquat pitch = glm::angleAxis(up, glm::dvec3(1.0, 0.0, 0.0));
  pose_.orientation = glm::normalize(pose_.orientation * yaw * pitch);
}

void Flight::orbit(double along_phi, double along_theta, double outward_factor) {
  constexpr double nearest_to_axis = 1e-3;
  pose_.phi += along_phi;
  pose_.theta = std::clamp(pose_.theta + along_theta, nearest_to_axis, 3.14159265358979323846 - nearest_to_axis);
  const double least = least_radius(show_);
  pose_.r = std::clamp(least + (pose_.r - least) * outward_factor, least + 1e-6, 1e5);
}

}  // namespace ergodome
