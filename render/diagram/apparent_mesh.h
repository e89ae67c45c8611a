#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"

namespace ergodome {

//! A corner of a mesh: where it stands, and where it seems to be.
struct ApparentVertex {
  Vector3<double> place;      //!< pseudo-Cartesian [M]
  Vector3<double> seen;       //!< from the observer where its light comes from, as far as that has taken time [M]
  Vector3<double> direction;  //!< of unit length, from the observer to there
  std::array<double, 2> texture;
  bool connected;  //!< whether light comes from there at all
};

//! A mesh as an observer at rest about a hole without spin sees it: Müller, Schulz & Weiskopf (2021), figures 6 and 10.
struct ApparentMesh {
  std::vector<ApparentVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

//! How finely a mesh is divided so that what is bent looks bent.
struct ApparentSettings {
  double tolerance = 0.05;  //!< how far the middle of an edge may be seen from the middle of its ends [M]
  int halvings = 6;         //!< of an edge, at the most
  double torn = 10.0;       //!< triangles that the hole tears: see ObjectSettings::torn
};

//! Where an observer sees a point on the ray of an image, 1 and up. `texture` is passed on.
ApparentVertex apparent_vertex(const Vector3<double>& observer, const Vector3<double>& point, int order,
                               const std::array<double, 2>& texture = {0.0, 0.0});

//! A point of a mesh where an object stands [M].
Vector3<double> placed_point(const ObjectPlacement& placement, double size, const float (&position)[3]);

//! The mesh of an image. Edges are halved until they are straight, the same for both of their triangles; triangles that the hole tears, and
//! those that reach to where no light comes from, are left out.
ApparentMesh apparent_mesh(const Vector3<double>& observer, const TriangleMesh& mesh, const ObjectPlacement& placement,
                           double size, int order, const ApparentSettings& settings);

}  // namespace ergodome
