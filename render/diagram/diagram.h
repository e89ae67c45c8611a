#pragma once

#include <map>
#include <vector>

#include "content/show/show.h"
#include "render/diagram/apparent_mesh.h"
#include "render/diagram/diagram_scene.h"
#include "render/passes/objects/object_meshes.h"
#include "render/passes/objects/object_rays.h"

namespace ergodome {

//! What a diagram shows of light.
struct DiagramSettings {
  std::vector<int> images;  //!< which orders, 1 to most_polygon_images; empty: 1 and 2, and all that traced rays see
  int rays = 24;            //!< about how many are drawn
};

//! A show's hole, observer and objects from outside, in flat space of pseudo-Cartesian coordinates, with the light rays between them (Müller,
//! Schulz & Weiskopf 2021, figures 6, 10 and 11).
//!
//! About a hole without spin rays are those that connect corners of the objects with the observer, and the objects are shown as they seem to be, too. Of a
//! hole that spins, and of retarded objects, rays of the observer's view are followed back.
class Diagram {
 public:
  //! Loads the meshes. Throws Error where the show has no objects, one cannot be read, or image orders are asked for where they are not told apart.
  Diagram(const Show& show, const DiagramSettings& settings);

  //! What there is at a show time. Throws Error where the camera cannot be there.
  [[nodiscard]] DiagramScene at(double time_s) const;

 private:
  struct Moment;
  using DelaysByOrder = std::map<int, std::map<int, std::vector<double>>>;  //!< of rays, by order and object [M]

  void add_objects(const Moment& moment, DiagramScene& scene) const;
  void add_connections(const Moment& moment, DiagramScene& scene) const;
  //! Corners that rays of an image are to start from: first of the sides that light leaves from, then others, for single sheets show both.
  [[nodiscard]] std::vector<Vector3<double>> ray_starts(const Moment& moment, std::size_t object, int order,
                                                        std::size_t count) const;
  void add_connecting_rays(const Moment& moment, std::size_t object, int order, int count, DiagramScene& scene) const;
  void add_traced_rays(const Moment& moment, DiagramScene& scene) const;
  //! Tells of the images that followed rays show, with retarded objects where they were; whether there are such.
  bool add_traced_images(const Moment& moment, DelaysByOrder& delays, DiagramScene& scene) const;

  Show show_;
  DiagramSettings settings_;
  ObjectMeshes meshes_;
  bool connects_;  //!< rays are those of the closed form
};

}  // namespace ergodome
