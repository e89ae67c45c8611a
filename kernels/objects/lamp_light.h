#pragma once

#include "kernels/objects/lamp_source.h"
#include "kernels/objects/light_ray.h"

// Illuminates surfaces by a lamp, about a hole of any spin.
namespace ergodome {

//! Light of a lamp that arrives at a point of a surface on both ways round the hole, with the frame
//! in which it is measured.
struct LampLight {
  LocalFrame frame;
  Vector3<double> velocity;      //!< velocity of the surface in the frame; 0 if it is not needed
  Vector3<double> direction[2];  //!< towards the light's origin, per way round the hole (LightRay)
  //! Illuminance, for each way round the hole, of a surface at rest in the frame that faces the
  //! light; 0 in shadow.
  double strength[2];
};

inline namespace ERGO_TARGET {

//! Returns whether an object of the scene is between a point and the lamp on a ray between them.
//! `from`: frame of a point slightly off the surface.
ERGO_HD bool in_shadow(const LocalFrame& from, const LightRay& ray, const MeshScene& scene, const MeshLimits& limits) {
  MeshHit hit;
  const CameraStation& camera = from.camera;
  trace_meshes<10, NearParts::azimuth_and_delay>(camera.spin, camera.cosine_phi, camera.sine_phi,
                                                 start_near_ray(camera, ray.direction), scene, limits, hit);
  return hit.mesh >= 0 && hit.delay - limits.delay < ray.travel_time;
}

namespace detail {

//! Returns the energy that a lamp at rest measures of a photon with energy 1 at infinity.
ERGO_HD double energy_at_rest(Spacetime spacetime, const Vector3<double>& position) {
  const double r2 = dot(position, position);
  const double a_cosine_squared = spacetime.spin * spacetime.spin * (position.z * position.z) / r2;
  return 1.0 / ::sqrt(1.0 - 2.0 * ::sqrt(r2) / (r2 + a_cosine_squared));
}

//! Returns the illuminance of a surface that faces the lamp: strength · e_R² / (e_L⁴ · spread),
//! where e_L and e_R are the photon's energies that the lamp and an observer at the surface
//! measure, and `spread` is that of LightRay. Without shift only the number of photons counts:
//! strength / (e_L² · spread). With falloff `published`: strength / travel_time².
ERGO_HD double strength_of(const LampSource& lamp, const LocalFrame& frame, const LightRay& ray) {
  // Next to the line from the lamp through the hole, behind the hole, only the size of a lamp would
  // keep its light finite, but this lamp is a point. So the brightening is limited, as for stars.
  constexpr double brightest = 1000.0;
  const double time = ::fmax(ray.travel_time, 1e-3);
  const double square = time * time;
  if (lamp.falloff == LampFalloff::published) {
    return lamp.strength / square;
  }
  const double at_lamp = energy_at_rest(spacetime_of(frame.camera), lamp.position);
  const double here = 1.0 / evaluate(frame.camera.energy, ray.direction);
  const double shift = lamp.shifted ? here / at_lamp : 1.0;
  return lamp.strength * shift * shift / ::fmax(at_lamp * at_lamp * ray.spread, square / brightest);
}

//! Converts the velocity dx/dt of a point of a surface (pseudo-Cartesian) to the frame. Returns 0
//! where nothing can move at this velocity.
ERGO_HD Vector3<double> velocity_in(const LocalFrame& frame, const Vector3<double>& point,
                                    const Vector3<double>& velocity) {
  const double beside = ::sqrt(point.x * point.x + point.y * point.y);
  const KerrFunctions f =
      kerr_functions(spacetime_of(frame.camera), ::sqrt(dot(point, point)), ::atan2(beside, point.z));
  const Vector3<double> along = in_axes(frame, velocity);
  const double by = 1.0 / ::sqrt(f.sigma * f.delta / f.area);
  const Vector3<double> v = {by * along.x / frame.normal_by.x, by * along.y / frame.normal_by.y,
                             by * (along.z - f.frame_dragging * beside) / frame.normal_by.z};
  return dot(v, v) < 1.0 ? v : Vector3<double>{0.0, 0.0, 0.0};
}

}  // namespace detail

//! Returns the illuminance by light from a direction, relative to that of a surface at rest in the
//! frame that faces it; 0 if the surface faces away. For k = ω (1, -d) and the surface's normal N
//! in spacetime, the fraction -k·N / ω = (n·v + n·d) / √(1 - (n·v)²) of it meets the surface, which
//! sees it shifted by γ (1 + v·d) relative to the frame. `normal`: of unit length,
//! pseudo-Cartesian.
ERGO_HD double meeting(const LampLight& light, const Vector3<double>& normal, const Vector3<double>& direction) {
  const Vector3<double> n = measured_normal(light.frame, normal);
  const Vector3<double>& v = light.velocity;
  const double moves = dot(n, v);
  const double shift = (1.0 + dot(v, direction)) / ::sqrt(1.0 - dot(v, v));
  return shift * ::fmax(0.0, (moves + dot(n, direction)) / ::sqrt(1.0 - moves * moves));
}

//! Returns the illuminance of a surface in the surface's own frame.
ERGO_HD double illuminance(const LampLight& light, const Vector3<double>& normal) {
  double sum = 0.0;
  for (int way = 0; way < 2; ++way) {
    if (light.strength[way] > 0.0) {
      sum += light.strength[way] * meeting(light, normal, light.direction[way]);
    }
  }
  return sum;
}

//! A lit point of a surface.
struct LitSurfacePoint {
  Vector3<double> point;     //!< the lit point, pseudo-Cartesian [M]
  Vector3<double> normal;    //!< outward unit normal of the surface there
  Vector3<double> velocity;  //!< velocity dx/dt of the surface there, pseudo-Cartesian
  Vector3<double> start;     //!< point slightly off the surface, so that the surface does not shadow itself
};

namespace detail {

//! Finds the ray from a lamp to a point that goes one given way round the hole. Returns false if
//! there is no such ray, or if, without spin, the closed form shows that the surface faces away.
ERGO_HD bool lamp_ray(const LampSource& lamp, const LampLight& light, const LitSurfacePoint& at, const LocalFrame& from,
                      int way, RayCorrection& correction, LightRay& ray) {
  const Spacetime spacetime = spacetime_of(from.camera);
  const auto find = [&](LightRayParts parts) {
    return light_ray(spacetime, from, at.start, lamp.position, way + 1, parts, correction, ray);
  };
  if (lamp.falloff == LampFalloff::published) {
    return find(LightRayParts::way);
  }
  if (spacetime.spin == 0.0 && !(find(LightRayParts::way) && meeting(light, at.normal, ray.direction) > 0.0)) {
    return false;
  }
  return find(LightRayParts::spread);
}

}  // namespace detail

//! Returns the light that arrives at a point of a surface on both ways round the hole, with
//! shadows. `limits.delay`: coordinate time from the point to the camera [M]. The rays end exactly
//! at `start`, not at the point itself: a ray round the hole that is turned by even a tiny angle
//! would end far from the lamp, and meet objects that it should pass.
ERGO_HD_CALLED LampLight lamp_light(Spacetime spacetime, const LampSource& lamp, const LitSurfacePoint& at,
                                    const MeshScene& scene, const MeshLimits& limits, LampCorrections& corrections) {
  // Light below this fraction of what has been found already is left out, as no display shows it.
  constexpr double negligible = 1.0 / 4096.0;
  LampLight light{};
  light.frame = local_frame(spacetime, at.point);
  if (lamp.falloff == LampFalloff::lens && lamp.shifted) {
    light.velocity = detail::velocity_in(light.frame, at.point, at.velocity);
  }
  const LocalFrame from = local_frame(spacetime, at.start);
  for (int way = 0; way < 2; ++way) {
    LightRay ray{};
    if (!detail::lamp_ray(lamp, light, at, from, way, corrections.by_way[way], ray) ||
        !(meeting(light, at.normal, ray.direction) > 0.0)) {
      continue;
    }
    const double strength = detail::strength_of(lamp, from, ray);
    if (strength > negligible * light.strength[0] && !in_shadow(from, ray, scene, limits)) {
      light.direction[way] = ray.direction;
      light.strength[way] = strength;
    }
  }
  return light;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
