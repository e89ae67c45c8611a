#pragma once

#include "kernels/mesh/mesh_rays.h"
#include "kernels/metric/camera_station.h"
#include "kernels/schwarzschild/apparent_place.h"
#include "kernels/shells/shell_crossings.h"

// Light from a point to a surface, about a hole of any spin.
namespace ergodome {

//! A point of light at rest.
struct LampPlace {
  Vector3<double> position;  //!< pseudo-Cartesian [M]
  double strength;           //!< 0: there is none
};

//! How light comes to a place.
struct LightRay {
  Vector3<double>
      direction;  //!< towards where it comes from, in the frame of an observer without angular momentum: e_r, e_θ, e_φ
  double travel_time;  //!< [M]
};

//! A place with the observer without angular momentum that is there.
struct LocalFrame {
  CameraStation camera;
  Vector3<double> axes[3];    //!< e_r, e_θ, e_φ by their pseudo-Cartesian parts
  Vector3<double> normal_by;  //!< factors of a normal's parts along them: what an unlike length makes of it
};

inline namespace ERGO_TARGET {

ERGO_HD Vector3<double> in_axes(const LocalFrame& frame, const Vector3<double>& v) {
  return {dot(frame.axes[0], v), dot(frame.axes[1], v), dot(frame.axes[2], v)};
}

//! The frame at a pseudo-Cartesian point outside the horizon.
ERGO_HD LocalFrame local_frame(double spin, const Vector3<double>& point) {
  const double r = ::sqrt(dot(point, point));
  const double beside = ::sqrt(point.x * point.x + point.y * point.y);
  const double sine = beside / r;
  const double cosine = point.z / r;
  const double cosine_phi = beside > 0.0 ? point.x / beside : 1.0;
  const double sine_phi = beside > 0.0 ? point.y / beside : 0.0;
  const KerrFunctions f = kerr_functions(spin, r, ::atan2(beside, point.z));
  LocalFrame frame{};
  frame.camera =
      make_camera_station(spin, r, ::atan2(beside, point.z), ::atan2(sine_phi, cosine_phi), ObserverMotion::zamo);
  frame.axes[0] = {sine * cosine_phi, sine * sine_phi, cosine};
  frame.axes[1] = {cosine * cosine_phi, cosine * sine_phi, -sine};
  frame.axes[2] = {-sine_phi, cosine_phi, 0.0};
  frame.normal_by = {::sqrt(f.delta / f.sigma), r / ::sqrt(f.sigma), r * ::sqrt(f.sigma / f.area)};
  return frame;
}

//! A surface's unit normal as the observer there measures it.
ERGO_HD Vector3<double> measured_normal(const LocalFrame& frame, const Vector3<double>& normal) {
  const Vector3<double> n = in_axes(frame, normal);
  const Vector3<double> by = {n.x * frame.normal_by.x, n.y * frame.normal_by.y, n.z * frame.normal_by.z};
  return (1.0 / ::sqrt(dot(by, by))) * by;
}

namespace detail {

//! Series of rays between a lamp and a place, and how exactly they go.
inline constexpr int lamp_order = 10;
inline constexpr double lamp_tolerance = 1e-8;
inline constexpr int lamp_steps = 2000;

//! Where a ray comes to a radius on its way out.
struct Arrival {
  Vector3<Dual<double>> outward;   //!< the place over its radius, pseudo-Cartesian
  double u_rate;                   //!< du/dλ along the way
  Vector3<double> polar_momentum;  //!< dm/dλ [M]
  double delay;                    //!< coordinate time from the start [M]
};

//! Follows a ray until it goes out past a radius that is not inside its start's. False where it does not.
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
    // From the farthest in on, where it goes in first.
    const double from = plain[1] > 0.0 ? value_of(time_to_turn(step.series.u, plain[1], step.length)) : 0.0;
    const Dual<double> h = time_to_zero(from_radius, 1.0, from, step.length);
    const Vector3<Dual<double>> place = step.point(h);
    const Vector3<Dual<double>> momentum = step.polar_momentum(h);
    arrival = {u * place,
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

//! Two unit vectors across n.
ERGO_HD void axes_across(const Vector3<double>& n, Vector3<double>& first, Vector3<double>& second) {
  const Vector3<double> axis = ::fabs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  first = cross(n, axis);
  first = (1.0 / ::sqrt(dot(first, first))) * first;
  second = cross(n, first);
}

//! Turns a direction at `camera` until its ray comes to a place that is no nearer to the hole: Newton. False where it does not get there.
ERGO_HD bool aim_at(const CameraStation& camera, const Vector3<double>& target, Vector3<double>& direction,
                    Arrival& arrival) {
  constexpr int most_rounds = 16;
  // The step that follows is the last one, and leaves next to nothing.
  constexpr double near_enough = 1e-5;
  constexpr double longest_step = 0.3;
  const double r = ::sqrt(dot(target, target));
  const Vector3<double> outward = (1.0 / r) * target;
  Vector3<double> target_axes[2];
  axes_across(outward, target_axes[0], target_axes[1]);
  for (int round = 0; round < most_rounds; ++round) {
    Vector3<double> axes[2];
    const Vector3<double>& d = direction;
    axes_across(d, axes[0], axes[1]);
    const Vector3<Dual<double>> n = {
        {d.x, axes[0].x, axes[1].x}, {d.y, axes[0].y, axes[1].y}, {d.z, axes[0].z, axes[1].z}};
    if (!follow_to_radius(camera, n, r, arrival)) {
      return false;
    }
    const Vector3<Dual<double>>& at = arrival.outward;
    const auto along = [&at](const Vector3<double>& e) { return e.x * at.x + e.y * at.y + e.z * at.z; };
    const Dual<double> miss[2] = {along(target_axes[0]), along(target_axes[1])};
    const double determinant = miss[0].along_x * miss[1].along_y - miss[0].along_y * miss[1].along_x;
    const double x = (miss[0].along_y * miss[1].value - miss[1].along_y * miss[0].value) / determinant;
    const double y = (miss[1].along_x * miss[0].value - miss[0].along_x * miss[1].value) / determinant;
    const double size = ::sqrt(x * x + y * y);
    if (!(size < 1e3)) {
      return false;
    }
    const double share = size > longest_step ? longest_step / size : 1.0;
    const Vector3<double> next = d + share * (x * axes[0] + y * axes[1]);
    direction = (1.0 / ::sqrt(dot(next, next))) * next;
    if (along(outward).value > 0.0 && ::fabs(miss[0].value) + ::fabs(miss[1].value) < near_enough) {
      return true;
    }
  }
  return false;
}

//! The same, the spin being raised to the frame's in steps where that takes it. `from`: where the frame is. `correction`: see light_ray.
ERGO_HD bool aim_with_spin(const LocalFrame& frame, const Vector3<double>& from, const Vector3<double>& target,
                           Vector3<double>& direction, Vector3<double>& correction, Arrival& arrival) {
  constexpr int raises = 6;
  const Vector3<double> start = direction;
  direction = start + correction;
  direction = (1.0 / ::sqrt(dot(direction, direction))) * direction;
  if (aim_at(frame.camera, target, direction, arrival)) {
    correction = direction - start;
    return true;
  }
  direction = start;
  for (int i = 1; i <= raises; ++i) {
    if (!aim_at(local_frame(frame.camera.spin * i / raises, from).camera, target, direction, arrival)) {
      return false;
    }
  }
  correction = direction - start;
  return true;
}

//! Where light that arrives seems to come from, for the observer without angular momentum there.
ERGO_HD Vector3<double> seen_from(const LocalFrame& frame, double r, const Arrival& arrival) {
  const Vector3<double> turn = in_axes(frame, arrival.polar_momentum);
  const Vector3<double>& by = frame.normal_by;
  // Momenta of an orthonormal frame: dr/dλ / √(ΣΔ), dθ/dλ / √Σ, L / (sinθ √(A/Σ)); normal_by has √(Δ/Σ), r/√Σ, r √(Σ/A).
  const Vector3<double> n = {arrival.u_rate * by.y * by.y / by.x, -turn.y * by.y / r, -turn.z * by.z / r};
  return (1.0 / ::sqrt(dot(n, n))) * n;
}

}  // namespace detail

//! Light from a lamp to a point, on the first or the second way round the hole: without spin in closed form (kernels/schwarzschild), else by Newton's
//! method on exact rays, which start at the end that is nearer to the hole. False where no ray is found. `correction`: what spin has added to the direction at a
//! place near by, and then here; 0 where nothing is known.
ERGO_HD_CALLED bool light_ray(double spin, const LocalFrame& frame, const Vector3<double>& point,
                              const Vector3<double>& lamp, int order, Vector3<double>& correction, LightRay& ray) {
  const ConnectionPlane plane = connection_plane(lamp, point);
  if (!(plane.r > 2.0)) {
    return false;
  }
  const ConnectingRay flat = connecting_ray(plane.r_observer, plane.r, image_angle(plane.phi, order));
  const ApparentPlace place = apparent_place(plane, order, flat.xi, flat.travel_time, flat.emission_angle);
  ray = {in_axes(frame, place.emission_direction), place.travel_time};
  if (spin == 0.0) {
    return true;
  }
  detail::Arrival arrival{};
  if (plane.r <= plane.r_observer) {
    const bool found = detail::aim_with_spin(frame, point, lamp, ray.direction, correction, arrival);
    ray.travel_time = arrival.delay;
    return found;
  }
  // The other way round time runs backwards, and the hole turns backwards.
  const LocalFrame at_lamp = local_frame(-spin, lamp);
  Vector3<double> direction = in_axes(at_lamp, place.direction);
  const bool found = detail::aim_with_spin(at_lamp, lamp, point, direction, correction, arrival);
  ray = {detail::seen_from(frame, plane.r, arrival), arrival.delay};
  return found;
}

//! Whether something of a scene stands between a place and the lamp on a ray between them. `from`: the frame of a point a little off the surface.
ERGO_HD bool in_shadow(const LocalFrame& from, const LightRay& ray, const MeshScene& scene, const MeshLimits& limits) {
  MeshHit hit;
  const CameraStation& camera = from.camera;
  trace_meshes<10, NearParts::azimuth_and_delay>(camera.spin, camera.cosine_phi, camera.sine_phi,
                                                 start_near_ray(camera, ray.direction), scene, limits, hit);
  return hit.mesh >= 0 && hit.delay - limits.delay < ray.travel_time;
}

//! Light of a lamp as it comes to a place on both ways round the hole, and to all that is near.
struct LampLight {
  LocalFrame frame;
  Vector3<double> direction[2];  //!< see LightRay
  double strength[2];            //!< on what faces it; 0 in shadow
};

//! Light that comes to a place of a surface: Müller, Schulz & Weiskopf (2021), eq. 20, with shadows; about a hole that spins, on the first way round alone.
//! `start`: a little off the surface, which keeps that from its own shadow; `limits.delay`: the delay of the place; `correction`: as light_ray has it.
//! The rays are those to `start`: one that goes round the hole and is turned the least bit ends up far off the lamp, and meets what it should pass.
ERGO_HD_CALLED LampLight lamp_light(double spin, const LampPlace& lamp, const Vector3<double>& point,
                                    const Vector3<double>& normal, const Vector3<double>& start, const MeshScene& scene,
                                    const MeshLimits& limits, Vector3<double>& correction) {
  // Less than this part of what has come already is left out: no display shows it.
  constexpr double negligible = 1.0 / 4096.0;
  LampLight light{};
  light.frame = local_frame(spin, point);
  const LocalFrame from = local_frame(spin, start);
  const Vector3<double> facing = measured_normal(light.frame, normal);
  for (int order = 1; order <= (spin == 0.0 ? 2 : 1); ++order) {
    LightRay ray{};
    if (!light_ray(spin, from, start, lamp.position, order, correction, ray)) {
      continue;
    }
    const double time = ::fmax(ray.travel_time, 1e-3);
    const double strength = lamp.strength / (time * time);
    if (!(strength > negligible * light.strength[0]) || !(dot(facing, ray.direction) > 0.0)) {
      continue;
    }
    if (!in_shadow(from, ray, scene, limits)) {
      light.direction[order - 1] = ray.direction;
      light.strength[order - 1] = strength;
    }
  }
  return light;
}

//! Illuminance of a surface at rest, as an observer without angular momentum measures it: eq. 21. `normal`: of unit length, pseudo-Cartesian.
ERGO_HD double illuminance(const LampLight& light, const Vector3<double>& normal) {
  const Vector3<double> n = measured_normal(light.frame, normal);
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    sum += light.strength[i] * ::fmax(0.0, dot(n, light.direction[i]));
  }
  return sum;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
