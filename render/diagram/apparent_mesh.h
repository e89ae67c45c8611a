#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"

// Meshes as an observer sees them near a hole without spin.

namespace ergodome {

//! A corner of a mesh with its true and its apparent position.
struct ApparentVertex {
  Vector3<double> place;  //!< pseudo-Cartesian [M]
  //! Apparent position: from the observer in the direction of the incoming light, at the distance
  //! that the light has traveled in time [M].
  Vector3<double> seen;
  Vector3<double> direction;  //!< unit vector from the observer to the apparent position
  std::array<double, 2> texture;
  bool connected;  //!< whether light from there reaches the observer
};

//! A mesh as an observer at rest sees it near a hole without spin: Müller, Schulz & Weiskopf
//! (2021), figures 6 and 10.
struct ApparentMesh {
  std::vector<ApparentVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

//! How finely a mesh is divided so that curved edges look curved.
struct ApparentSettings {
  //! Maximum apparent distance between the middle of an edge and the middle of its ends [M].
  double tolerance = 0.05;
  int halvings = 6;    //!< maximum number of halvings of an edge
  double torn = 10.0;  //!< limit for triangles that the hole tears: see ObjectSettings::torn
};

//! Computes where an observer sees a point on the ray of an image (order 1 and up). `texture` is
//! passed on.
ApparentVertex apparent_vertex(const Vector3<double>& observer, const Vector3<double>& point, int order,
                               const std::array<double, 2>& texture = {0.0, 0.0});

//! Transforms a point from a mesh's own coordinates to pseudo-Cartesian coordinates [M]: scales,
//! rotates and moves it as the object is placed.
Vector3<double> placed_point(const ObjectPlacement& placement, double size, const float (&position)[3]);

//! Computes the mesh of an image. Edges are halved until they are straight, consistently for both
//! of their triangles. Omits triangles that the hole tears, and those with corners from which no
//! light arrives.
ApparentMesh apparent_mesh(const Vector3<double>& observer, const TriangleMesh& mesh, const ObjectPlacement& placement,
                           double size, int order, const ApparentSettings& settings);

}  // namespace ergodome
