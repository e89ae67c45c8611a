#pragma once

#include <algorithm>
#include <random>
#include <string>

#include "app/navigation/navigator.h"
#include "content/show/reading/show_reader.h"

// Shows, flights and simulated input for tests of the navigator.
namespace ergodome::test {

inline constexpr double frame_s = 1.0 / 60.0;

inline Show show_at(double spin, double r, double theta_deg = 90.0, const std::string& flight = "") {
  return parse_show("duration_s = 60\n[hole]\nspin = " + std::to_string(spin) + "\n[camera]\n[[camera.key]]\nr = " +
                        std::to_string(r) + "\ntheta_deg = " + std::to_string(theta_deg) + "\n[flight]\n" + flight,
                    "f.toml");
}

inline SteeringInput holding(const Steering& rates) { return {rates, {}}; }

class Flier {
 public:
  explicit Flier(const Show& show) : path(camera_pose(show, 0.0)), navigator(show) { navigator.leave_path(); }

  void hold(const Steering& rates, double seconds) {
    for (double t = 0.0; t < seconds - 1e-9; t += frame_s) {
      navigator.advance(frame_s, holding(rates), path);
    }
  }

  CameraPose path;
  Navigator navigator;
};

inline Steering forward_only(double forward) {
  Steering s;
  s.forward = forward;
  s.faster = 1.0;
  return s;
}

//! Returns the viewing direction relative to nonrotating directions.
inline glm::dvec3 looks_at(const Navigator& navigator) {
  return placement_of(navigator.pose()).view * glm::dvec3(0.0, 0.0, -1.0);
}

inline double angle_between(const glm::dquat& a, const glm::dquat& b) {
  return glm::length(turn_of(b * glm::conjugate(a)));
}

//! Returns random input, including values that no device sends.
inline Steering wild(std::mt19937& random) {
  std::uniform_real_distribution<double> rate(-1.5, 1.5);
  const auto pick = [&] {
    switch (random() % 12) {
      case 0:
        return std::nan("");
      case 1:
        return 1e300;
      case 2:
        return -1.0;
      default:
        return rate(random);
    }
  };
  return {pick(), pick(), pick(), pick(), pick(), pick(), pick(), pick()};
}

//! Returns a show whose camera path never rests.
inline Show moving_show(double spin = 0.9) {
  return parse_show("duration_s = 100\n[hole]\nspin = " + std::to_string(spin) + R"(
[camera]
[[camera.key]]
t_s = 0
r = 12
theta_deg = 80
[[camera.key]]
t_s = 50
r = 6
theta_deg = 30
phi_deg = 300
yaw_deg = 40
[[camera.key]]
t_s = 100
r = 9
theta_deg = 90
phi_deg = 500
)",
                    "m.toml");
}

}  // namespace ergodome::test
