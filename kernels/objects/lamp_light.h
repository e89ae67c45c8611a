#pragma once

#include "kernels/objects/lamp_place.h"
#include "kernels/objects/light_ray.h"

// What a lamp's light does to a surface, about a hole of any spin.
namespace ergodome {

//! Light of a lamp as it comes to a place on both ways round the hole, and to all that is near.
struct LampLight {
  LocalFrame frame;
  Vector3<double> velocity;      //!< of the surface, in the frame; 0 where that is not called for
  Vector3<double> direction[2];  //!< see LightRay
  double strength[2];            //!< on what rests in the frame and faces it; 0 in shadow
};

inline namespace ERGO_TARGET {

//! Whether something of a scene stands between a place and the lamp on a ray between them. `from`: the frame of a point a little off the surface.
ERGO_HD bool in_shadow(const LocalFrame& from, const LightRay& ray, const MeshScene& scene, const MeshLimits& limits) {
  MeshHit hit;
  const CameraStation& camera = from.camera;
  trace_meshes<10, NearParts::azimuth_and_delay>(camera.spin, camera.cosine_phi, camera.sine_phi,
                                                 start_near_ray(camera, ray.direction), scene, limits, hit);
  return hit.mesh >= 0 && hit.delay - limits.delay < ray.travel_time;
}

namespace detail {

//! Energy that a lamp at rest measures of a photon of energy 1 at infinity.
ERGO_HD double energy_at_rest(double spin, const Vector3<double>& place) {
  const double r2 = dot(place, place);
  const double a_cosine_squared = spin * spin * (place.z * place.z) / r2;
  return 1.0 / ::sqrt(1.0 - 2.0 * ::sqrt(r2) / (r2 + a_cosine_squared));
}

//! What a lamp gives to a surface that faces it: strength · e_R² / (e_L⁴ · spread), with the energies that lamp and surface measure; without shift
//! that of the photons' number alone is left, strength / (e_L² · spread).
ERGO_HD double strength_of(const LampPlace& lamp, const LocalFrame& frame, const LightRay& ray) {
  // Next to the axis behind the hole the lamp's own size, which it has not, would be what keeps its light finite. As for stars.
  constexpr double brightest = 1000.0;
  const double time = ::fmax(ray.travel_time, 1e-3);
  const double square = time * time;
  if (lamp.falloff == LampFalloff::published) {
    return lamp.strength / square;
  }
  const double at_lamp = energy_at_rest(frame.camera.spin, lamp.position);
  const double here = 1.0 / evaluate(frame.camera.energy, ray.direction);
  const double shift = lamp.shifted ? here / at_lamp : 1.0;
  return lamp.strength * shift * shift / ::fmax(at_lamp * at_lamp * ray.spread, square / brightest);
}

//! The velocity of a place of a surface in the frame, of dx/dt = `velocity` (pseudo-Cartesian); 0 where nothing can move like that.
ERGO_HD Vector3<double> velocity_in(const LocalFrame& frame, const Vector3<double>& point,
                                    const Vector3<double>& velocity) {
  const double beside = ::sqrt(point.x * point.x + point.y * point.y);
  const KerrFunctions f = kerr_functions(frame.camera.spin, ::sqrt(dot(point, point)), ::atan2(beside, point.z));
  const Vector3<double> along = in_axes(frame, velocity);
  const double by = 1.0 / ::sqrt(f.sigma * f.delta / f.area);
  const Vector3<double> v = {by * along.x / frame.normal_by.x, by * along.y / frame.normal_by.y,
                             by * (along.z - f.frame_dragging * beside) / frame.normal_by.z};
  return dot(v, v) < 1.0 ? v : Vector3<double>{0.0, 0.0, 0.0};
}

}  // namespace detail

//! What light from a direction gives to a surface, over what it gives to one that rests in the frame and faces it; 0 to one that faces away. For
//! k = ω (1, -d) and the surface's normal N in space and time -k·N / ω = (n·v + n·d) / √(1 - (n·v)²) of it meets the surface, which sees it shifted by
//! γ (1 + v·d) against the frame. `normal`: of unit length, pseudo-Cartesian.
ERGO_HD double meeting(const LampLight& light, const Vector3<double>& normal, const Vector3<double>& direction) {
  const Vector3<double> n = measured_normal(light.frame, normal);
  const Vector3<double>& v = light.velocity;
  const double moves = dot(n, v);
  const double shift = (1.0 + dot(v, direction)) / ::sqrt(1.0 - dot(v, v));
  return shift * ::fmax(0.0, (moves + dot(n, direction)) / ::sqrt(1.0 - moves * moves));
}

//! Illuminance of a surface, as it measures it itself.
ERGO_HD double illuminance(const LampLight& light, const Vector3<double>& normal) {
  double sum = 0.0;
  for (int way = 0; way < 2; ++way) {
    if (light.strength[way] > 0.0) {
      sum += light.strength[way] * meeting(light, normal, light.direction[way]);
    }
  }
  return sum;
}

//! A lit place of a surface.
struct LitPlace {
  Vector3<double> point;     //!< pseudo-Cartesian [M]
  Vector3<double> normal;    //!< of unit length
  Vector3<double> velocity;  //!< dx/dt
  Vector3<double> start;     //!< a little off the surface, which keeps it from its own shadow
};

namespace detail {

//! The ray of one way from a lamp to a place. False where there is none, or where a hole without spin lets the closed form tell that the surface faces away.
ERGO_HD bool lamp_ray(const LampPlace& lamp, const LampLight& light, const LitPlace& at, const LocalFrame& from,
                      int way, RayCorrection& correction, LightRay& ray) {
  const double spin = from.camera.spin;
  const auto find = [&](LightRayParts parts) {
    return light_ray(spin, from, at.start, lamp.position, way + 1, parts, correction, ray);
  };
  if (lamp.falloff == LampFalloff::published) {
    return find(LightRayParts::way);
  }
  if (spin == 0.0 && !(find(LightRayParts::way) && meeting(light, at.normal, ray.direction) > 0.0)) {
    return false;
  }
  return find(LightRayParts::spread);
}

}  // namespace detail

//! Light that comes to a place of a surface on both ways round the hole, with shadows. `limits.delay`: the delay of the place.
//! The rays are those to `start`: one that goes round the hole and is turned the least bit ends up far off the lamp, and meets what it should pass.
ERGO_HD_CALLED LampLight lamp_light(double spin, const LampPlace& lamp, const LitPlace& at, const MeshScene& scene,
                                    const MeshLimits& limits, LampCorrections& corrections) {
  // Less than this part of what has come already is left out: no display shows it.
  constexpr double negligible = 1.0 / 4096.0;
  LampLight light{};
  light.frame = local_frame(spin, at.point);
  if (lamp.falloff == LampFalloff::lens && lamp.shifted) {
    light.velocity = detail::velocity_in(light.frame, at.point, at.velocity);
  }
  const LocalFrame from = local_frame(spin, at.start);
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
