#pragma once

#include <map>
#include <vector>

#include "content/show/show.h"
#include "render/diagram/apparent_mesh.h"
#include "render/diagram/diagram_scene.h"
#include "render/passes/objects/object_meshes.h"
#include "render/passes/objects/object_rays.h"

// Diagrams of a show's light rays, seen from outside.

namespace ergodome {

//! Which light rays a diagram shows.
struct DiagramSettings {
  //! Orders of the images whose rays are shown, 1 to max_polygon_images. Empty: orders 1 and 2, or
  //! all orders that occur if rays are traced.
  std::vector<int> images;
  int rays = 24;  //!< approximate number of rays
};

//! A show's hole, observer and objects seen from outside, in flat space with pseudo-Cartesian
//! coordinates, with the light rays between them (Müller, Schulz & Weiskopf 2021, figures 6, 10 and
//! 11).
//!
//! For a hole without spin, rays connect corners of the objects with the observer, and the objects
//! are also shown at their apparent positions. For a spinning hole, and for retarded objects, rays
//! of the observer's view are traced back.
class Diagram {
 public:
  //! Loads the meshes. Throws Error if the show has no objects, if a mesh cannot be read, if all
  //! together have more than 2,000,000 triangles, or if image orders are requested although traced
  //! rays cannot select them.
  Diagram(const Show& show, const DiagramSettings& settings);

  //! Returns the scene at a show time. Throws Error if the camera cannot be at its position.
  [[nodiscard]] DiagramScene at(double time_s) const;

 private:
  struct Moment;
  //! Light travel times of the shown rays [M], by image order and by the object's index in the
  //! show.
  using DelaysByOrder = std::map<int, std::map<int, std::vector<double>>>;

  void add_objects(const Moment& moment, DiagramScene& scene) const;
  void add_connections(const Moment& moment, DiagramScene& scene) const;
  //! Returns up to `count` mesh corners, far from each other, where rays of an image order start:
  //! first corners on sides that emit light towards the observer, then others, because thin meshes
  //! without an inside show both sides.
  [[nodiscard]] std::vector<Vector3<double>> ray_starts(const Moment& moment, std::size_t object, int order,
                                                        std::size_t count) const;
  void add_connecting_rays(const Moment& moment, std::size_t object, int order, int count, DiagramScene& scene) const;
  void add_traced_rays(const Moment& moment, DiagramScene& scene) const;
  //! Adds a legend line for each image order of the traced rays. Also adds retarded objects that
  //! move, translucent, where they were when the light left them, and returns whether there are
  //! any.
  bool add_traced_images(const Moment& moment, DelaysByOrder& delays, DiagramScene& scene) const;

  Show show_;
  DiagramSettings settings_;
  ObjectMeshes meshes_;
  //! True: rays connect points in closed form; false: rays are traced back from the eye.
  bool connects_;
};

}  // namespace ergodome
