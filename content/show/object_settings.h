#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/mesh/mesh_shapes.h"
#include "content/timeline/timeline.h"
#include "kernels/objects/lamp_source.h"
#include "kernels/spacetime/schwarzschild/tessellation.h"
#include "kernels/spacetime/spacetime.h"

namespace ergodome {

//! The surface of an object: a mesh file, or a built-in mesh.
enum class ObjectForm { mesh, triangle, sphere, disk };

//! How objects are drawn.
enum class ObjectMethod {
  polygon,  //!< vertices move to where their light comes from; only for holes without spin
  trace     //!< exact rays, for any spin
};

//! Names of ObjectMethod, in its order.
inline constexpr std::array object_method_names = {"polygon", "trace"};

//! A circular orbit, traversed at the angular velocity of orbit_rate().
struct ObjectOrbit {
  double r = 10.0;           //!< radius of the orbit [M]
  double phi = 0.0;          //!< angle on the orbit at show time 0, from the ascending node [rad]
  double inclination = 0.0;  //!< inclination of the orbit to the plane z = 0 [rad]
  double node = 0.0;         //!< azimuth of the ascending node [rad]
  double speed = 20.0;       //!< M of the hole's time per second of the show; negative runs backward
  Spacetime spacetime{};     //!< spacetime of the hole at the center

  bool operator==(const ObjectOrbit&) const = default;
};

//! The position of an object at a time of the show.
struct ObjectKey {
  double time_s = 0.0;
  //! Position of the mesh's origin, pseudo-Cartesian as in ObjectSettings [M].
  Vector3<double> position = {0.0, 0.0, 0.0};
  Ease ease = Ease::smooth;  //!< easing from this key to the next
};

//! A checkerboard over the texture coordinates.
struct CheckerSettings {
  int columns = 8;
  int rows = 8;
  double dark = 0.35;  //!< factor on the light of every second field

  bool operator==(const CheckerSettings&) const = default;
};

//! A triangle mesh in the scene: one of a show's [[objects]]. Positions are pseudo-Cartesian: x = r
//! sinθ cosφ, y = r sinθ sinφ, z = r cosθ [M].
struct ObjectSettings {
  ObjectForm form = ObjectForm::sphere;
  std::string mesh;  //!< path relative to the show, for ObjectForm::mesh
  TriangleShape triangle;
  SphereShape sphere;
  DiskShape disk;
  double size = 1.0;  //!< M per unit of the mesh
  //! Rotation around the x, then the y, then the z axis [rad].
  Vector3<double> turn = {0.0, 0.0, 0.0};
  Vector3<double> position = {0.0, 0.0, 0.0};  //!< position of the mesh's origin [M]
  //! Orbit of the mesh's origin, if set instead of the position.
  std::optional<ObjectOrbit> orbit;
  std::vector<ObjectKey> keys;              //!< in order of time; replace the position if there are any
  Vector3<double> color = {1.0, 1.0, 1.0};  //!< linear light; multiplies the color of the mesh
  double exposure = 1.0;
  std::optional<CheckerSettings> checker;
  bool lit = false;  //!< reflects the show's point light by Lambert's law; otherwise emits light
  ObjectMethod method = ObjectMethod::polygon;
  //! True: traced objects are seen at the positions that they had when their light left them.
  bool retarded = false;
  TessellationSettings tessellation;
  //! Number of images that polygons draw: 1 is the direct image; each further one goes half a turn
  //! further around the hole.
  int images = 2;
  //! Maximum factor by which lensing may enlarge a triangle's perimeter. Above it, the triangle is
  //! torn and not drawn.
  double torn = 10.0;
};

//! A static point light.
struct PointLight {
  //! The light's position, pseudo-Cartesian as in ObjectSettings [M].
  Vector3<double> position = {0.0, 0.0, 0.0};
  //! Illuminance, in white light, of a surface that faces the light at a distance of 1 M in flat
  //! space.
  double strength = 1.0;
  //! How light on traced objects decreases with distance.
  LampFalloff falloff = LampFalloff::lens;
};

//! Maximum number of images that polygons draw. The fifth is 10^-6 as wide as the first, which
//! float tables barely distinguish from the edge of the shadow.
inline constexpr int max_polygon_images = 5;

//! Radii [M]. The first two: range for triangles of objects with ObjectMethod::polygon. The third:
//! minimum for orbits of objects, for lights and, with ObjectMethod::polygon, for cameras.
inline constexpr double nearest_of_objects = 2.1;
inline constexpr double farthest_of_objects = 1e5;
inline constexpr double nearest_of_observers = 3.0;

}  // namespace ergodome
