#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"

// Meshes as an observer sees them near a hole without spin.

namespace ergodome {

//! A corner of a mesh with its true position and the position where an observer sees it.
struct ApparentVertex {
  Vector3<double> position;  //!< true position, pseudo-Cartesian [M]
  //! Apparent position: from the observer in the direction of the incoming light, at a distance
  //! equal to the light travel time [M]. The true position if not `connected`.
  Vector3<double> seen;
  Vector3<double> direction;  //!< unit vector from the observer to `seen`; 0 if not `connected`
  std::array<double, 2> texture;
  bool connected;  //!< whether light of the image order reaches the observer from `position`
};

//! A mesh as an observer at rest near a hole without spin sees it: Müller, Schulz & Weiskopf
//! (2021), figures 6 and 10.
struct ApparentMesh {
  std::vector<ApparentVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

//! How finely a mesh is divided so that curved edges look curved.
struct ApparentSettings {
  //! Maximum distance between the apparent position of an edge's midpoint and the midpoint of the
  //! apparent positions of its ends [M].
  double tolerance = 0.05;
  int halvings = 6;    //!< maximum number of halvings of an edge
  double torn = 10.0;  //!< limit for triangles that the hole tears: see ObjectSettings::torn
};

//! Computes where an observer sees a point, by the ray of a given image order (1 is the direct
//! image). `texture` is copied to the result.
ApparentVertex apparent_vertex(const Vector3<double>& observer, const Vector3<double>& point, int order,
                               const std::array<double, 2>& texture = {0.0, 0.0});

//! Transforms a point from a mesh's own coordinates to pseudo-Cartesian coordinates [M]: scales,
//! rotates and moves it as the object is placed.
Vector3<double> placed_point(const ObjectPlacement& placement, double size, const float (&position)[3]);

//! Computes the apparent mesh of one image order. Divides edges until they look straight, in the
//! same way for both triangles at an edge, but at most settings.halvings times and until there are
//! a million triangles. Omits triangles that the hole tears apart, and those with a corner from
//! which no light arrives.
ApparentMesh apparent_mesh(const Vector3<double>& observer, const TriangleMesh& mesh, const ObjectPlacement& placement,
                           double size, int order, const ApparentSettings& settings);

}  // namespace ergodome
