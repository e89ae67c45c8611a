#pragma once

#include "kernels/objects/mesh_rays.h"
#include "kernels/shells/shell_crossings.h"
#include "kernels/spacetime/kerr/camera_station.h"

// Rays that are aimed at a point: how far they miss it, and the Newton step that corrects them.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Order and precision of the series of rays between a lamp and a point.
inline constexpr int lamp_order = 10;
inline constexpr double lamp_tolerance = 1e-6;
inline constexpr int lamp_steps = 2000;

//! Where a ray passes a radius on its way out.
struct Arrival {
  //! Position where it arrives, divided by its radius; pseudo-Cartesian.
  Vector3<Dual<double>> outward;
  double u_rate;                   //!< du/dλ of the ray there; u = 1/r, λ: Mino time
  Vector3<double> polar_momentum;  //!< dm/dλ of the ray there [M]; m: unit vector from the hole
  double delay;                    //!< coordinate time from the ray's start to there [M]
};

//! Follows a ray until it passes outwards through the radius r, which must be at least that of the
//! ray's start. Returns false if it never does.
ERGO_HD bool follow_to_radius(const CameraStation& camera, const Vector3<Dual<double>>& n, double r, Arrival& arrival) {
  const double u = 1.0 / r;
  bool arrived = false;
  const auto visit = [&](int, const PathStep<lamp_order, NearParts::azimuth_and_delay, Dual<double>>& step) {
    Dual<double> from_radius[lamp_order + 1];
    double plain[lamp_order + 1];
    for (int k = 0; k <= lamp_order; ++k) {
      from_radius[k] = step.series.u[k];
      plain[k] = value_of(step.series.u[k]);
    }
    if (!(plain[0] >= u) || !(series_value(plain, step.length) < u)) {
      return false;
    }
    from_radius[0] = from_radius[0] - u;
    // If the ray goes inwards first, searches from its innermost point on.
    const double from = plain[1] > 0.0 ? value_of(time_to_turn(step.series.u, plain[1], step.length)) : 0.0;
    const Dual<double> h = time_to_zero(from_radius, 1.0, from, step.length);
    const Vector3<Dual<double>> position = step.point(h);
    const Vector3<Dual<double>> momentum = step.polar_momentum(h);
    arrival = {u * position,
               step.scale * value_of(series_rate(step.series.u, h)),
               {momentum.x.value, momentum.y.value, momentum.z.value},
               step.delay(value_of(h))};
    arrived = true;
    return true;
  };
  follow_path<lamp_order, NearParts::azimuth_and_delay>(camera.spin, camera.cosine_phi, camera.sine_phi,
                                                        start_near_ray(camera, n), {1.001 * camera.horizon_r, 2.0 * r},
                                                        MeshLimits{lamp_tolerance, lamp_steps}, true, visit);
  return arrived;
}

//! Computes two unit vectors perpendicular to n.
ERGO_HD void axes_across(const Vector3<double>& n, Vector3<double>& first, Vector3<double>& second) {
  const Vector3<double> axis = ::fabs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  first = cross(n, axis);
  first = (1.0 / ::sqrt(dot(first, first))) * first;
  second = cross(n, first);
}

//! A point that rays are aimed at.
struct RayTarget {
  double r;                 //!< the point's radius coordinate [M]
  Vector3<double> outward;  //!< unit vector from the hole to the point
  Vector3<double> axes[2];  //!< unit vectors perpendicular to `outward` and to each other
  //! Miss [rad about the hole] below which the next step is the last: it leaves a negligible error.
  double near_enough;
};

//! Returns the target of rays from a point. `near_enough`: for distances of at least the target's
//! radius; it is reduced for shorter ones.
ERGO_HD RayTarget ray_target(const Vector3<double>& from, const Vector3<double>& position, double near_enough) {
  RayTarget target{};
  target.r = ::sqrt(dot(position, position));
  target.outward = (1.0 / target.r) * position;
  axes_across(target.outward, target.axes[0], target.axes[1]);
  const Vector3<double> way = position - from;
  target.near_enough = near_enough * ::fmin(1.0, ::sqrt(dot(way, way)) / target.r);
  return target;
}

//! How a ray misses its target, and the Newton step that corrects it.
struct Miss {
  Arrival arrival;
  double size;     //!< distance between arrival and target, as an angle about the hole [rad]
  bool same_side;  //!< the ray arrives on the target's side of the hole
  double step[2];  //!< Newton step of the two numbers that parametrize the direction
  double spread;   //!< see LightRay
  bool mirrored;   //!< the bundle arrives mirrored, as for images of the second way
};

//! Traces a ray to the radius of a point that is at least as far from the hole as the camera. `n`:
//! its direction at `camera`, with its derivatives by two numbers. Returns false if it does not get
//! there, or if no usable step corrects it.
//!
//! The bundle's cross-section at the point, on a screen perpendicular to the ray for an observer
//! without angular momentum, is √A |n_r| (1 - ω L) times that in θ and φ sinθ at constant r. There
//! ξ·k = 0 accounts for the different times of its rays, and n_r √A (1 - ω L) is dr/dλ; all for
//! energy 1 at infinity.
ERGO_HD bool miss_of(const CameraStation& camera, const RayTarget& target, const Vector3<Dual<double>>& n, Miss& miss) {
  if (!follow_to_radius(camera, n, target.r, miss.arrival)) {
    return false;
  }
  const Vector3<Dual<double>>& at = miss.arrival.outward;
  const auto along = [&at](const Vector3<double>& e) { return e.x * at.x + e.y * at.y + e.z * at.z; };
  const Dual<double> off[2] = {along(target.axes[0]), along(target.axes[1])};
  const double determinant = off[0].along_x * off[1].along_y - off[0].along_y * off[1].along_x;
  miss.step[0] = (off[0].along_y * off[1].value - off[1].along_y * off[0].value) / determinant;
  miss.step[1] = (off[1].along_x * off[0].value - off[0].along_x * off[1].value) / determinant;
  miss.size = ::fabs(off[0].value) + ::fabs(off[1].value);
  miss.same_side = along(target.outward).value > 0.0;
  const Vector3<double> area = cross(Vector3<double>{n.x.along_x, n.y.along_x, n.z.along_x},
                                     Vector3<double>{n.x.along_y, n.y.along_y, n.z.along_y});
  miss.mirrored = determinant * dot(plain_vector(n), area) < 0.0;
  miss.spread = ::fabs(determinant * miss.arrival.u_rate) * (target.r * target.r) *
                evaluate(camera.energy, plain_vector(n)) / ::sqrt(dot(area, area));
  return ::fabs(miss.step[0]) + ::fabs(miss.step[1]) < 1e3;
}

//! Maximum number of Newton steps.
inline constexpr int max_aim_rounds = 16;

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
