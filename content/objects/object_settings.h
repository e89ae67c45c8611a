#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "content/mesh/mesh_shapes.h"
#include "content/timeline/timeline.h"
#include "kernels/objects/lamp_place.h"
#include "kernels/spacetime/schwarzschild/tessellation.h"

namespace ergodome {

//! What an object's surface is: a mesh from a file, or one made by code.
enum class ObjectForm { mesh, triangle, sphere, disk };

//! How objects are drawn.
enum class ObjectMethod {
  polygon,  //!< corners go where their light comes from: holes without spin
  trace     //!< exact rays, of any spin
};

//! A circular orbit, run through at the angular velocity of matter in free fall: see orbit_rate().
struct ObjectOrbit {
  double r = 10.0;           //!< [M]
  double phi = 0.0;          //!< where on the orbit it is at time 0, from the ascending node [rad]
  double inclination = 0.0;  //!< of the orbit to the plane z = 0 [rad]
  double node = 0.0;         //!< azimuth where it goes through that plane upwards [rad]
  double speed = 20.0;       //!< M of the hole's time in a second of the show; below 0 it goes backwards
  double spin = 0.0;         //!< of the hole that it is about [M]

  bool operator==(const ObjectOrbit&) const = default;
};

//! A checkerboard over the texture coordinates.
struct CheckerSettings {
  int columns = 8;
  int rows = 8;
  double dark = 0.35;  //!< factor on the light of every other field

  bool operator==(const CheckerSettings&) const = default;
};

//! Thing of triangles: one of a show's [[objects]]. Places are pseudo-Cartesian: x = r sinθ cosφ, y = r sinθ sinφ, z = r cosθ [M].
struct ObjectSettings {
  ObjectForm form = ObjectForm::sphere;
  std::string mesh;  //!< path relative to the show, for ObjectForm::mesh
  TriangleShape triangle;
  SphereShape sphere;
  DiskShape disk;
  double size = 1.0;                           //!< M in a unit of the mesh
  Vector3<double> turn = {0.0, 0.0, 0.0};      //!< about the x, then the y, then the z axis [rad]
  Vector3<double> position = {0.0, 0.0, 0.0};  //!< of the mesh's own middle [M]
  std::optional<ObjectOrbit> orbit;            //!< in place of the position
  std::array<Animation, 3> way;  //!< x, y, z in the course of time, in place of the position, where they have keys
  Vector3<double> color = {1.0, 1.0, 1.0};  //!< linear light; multiplies that of the mesh
  double exposure = 1.0;
  std::optional<CheckerSettings> checker;
  bool lit = false;  //!< shines back the show's point light, as Lambert says; else it shines by itself
  ObjectMethod method = ObjectMethod::polygon;
  bool retarded = false;  //!< traced: it is seen where it was when its light left it
  TessellationSettings tessellation;
  int images = 2;      //!< of polygons: 1, the direct one; each more goes half a turn further round the hole
  double torn = 10.0;  //!< triangles whose circumference grows by more are taken for torn by the hole and left out
};

//! A point of light at rest.
struct PointLight {
  Vector3<double> position = {0.0, 0.0, 0.0};  //!< pseudo-Cartesian [M]
  double strength = 1.0;                       //!< white light on what faces it at a distance of 1 M in flat space
  LampFalloff falloff = LampFalloff::lens;     //!< of what is traced
};

//! Images of an object that polygons draw at the most: the fifth is 10^-6 as wide as the first, which tables in float just tell from the edge.
inline constexpr int most_polygon_images = 5;

//! Radii that the triangles of objects may reach [M], and those where they may be seen and lit from.
inline constexpr double nearest_of_objects = 2.1;
inline constexpr double farthest_of_objects = 1e5;
inline constexpr double nearest_of_observers = 3.0;

}  // namespace ergodome
