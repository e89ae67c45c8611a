#pragma once

#include "kernels/objects/triangle_tree.h"

// Meshes placed in space, at rest or on circular orbits.
namespace ergodome {

//! A circle on which a mesh moves, as a function of coordinate time.
struct MeshOrbit {
  Vector3<double> toward;  //!< vector from the hole's center to the mesh at the camera's time [M]
  //! Vector from the hole's center to its position a quarter of the circle later [M].
  Vector3<double> ahead;
  double rate = 0.0;  //!< angular velocity [1/M]; 0: at rest
};

//! A mesh in space: its point p is at position + size · rows · p, pseudo-Cartesian: x = r sinθ
//! cosφ, y = r sinθ sinφ, z = r cosθ [M].
struct PlacedMesh {
  TriangleTree tree;
  Vector3<double> position;  //!< position of the mesh's origin at the camera's time [M]
  double rows[3][3];         //!< rotation from the mesh's axes to space
  double size;               //!< M per unit of the mesh
  MeshOrbit orbit = {};      //!< circular motion of the mesh; at rest if its rate is 0
  //! Whether the mesh is seen at the position that it had when the light left it, not at its
  //! present position.
  bool retarded = false;
};

//! The meshes of a scene, and the range of radii in which they are.
struct MeshScene {
  const PlacedMesh* meshes;
  int count;
  double min_r;  //!< no mesh reaches farther in; outside the horizon [M]
  double max_r;  //!< no mesh reaches farther out [M]
};

inline namespace ERGO_TARGET {

//! Returns the position of a mesh's origin (PlacedMesh::position) `delay` before the camera's time
//! [M]. For meshes that are not retarded, returns the position at the camera's time.
ERGO_HD Vector3<double> mesh_position(const PlacedMesh& mesh, double delay) {
  if (!mesh.retarded) {
    return mesh.position;
  }
  const double angle = mesh.orbit.rate * delay;
  return ::cos(angle) * mesh.orbit.toward - ::sin(angle) * mesh.orbit.ahead;
}

//! Returns a mesh's velocity dx/dt at the time for which mesh_position() returns its position.
ERGO_HD Vector3<double> mesh_velocity(const PlacedMesh& mesh, double delay) {
  const double angle = mesh.retarded ? mesh.orbit.rate * delay : 0.0;
  return mesh.orbit.rate * (::sin(angle) * mesh.orbit.toward + ::cos(angle) * mesh.orbit.ahead);
}

//! Rotates a vector from the mesh's axes to space.
ERGO_HD Vector3<double> turned_with_mesh(const PlacedMesh& mesh, const Vector3<double>& v) {
  const auto& rows = mesh.rows;
  return {rows[0][0] * v.x + rows[0][1] * v.y + rows[0][2] * v.z,
          rows[1][0] * v.x + rows[1][1] * v.y + rows[1][2] * v.z,
          rows[2][0] * v.x + rows[2][1] * v.y + rows[2][2] * v.z};
}

//! Returns the center of the bounding ball of a mesh whose origin is at `position` [M].
ERGO_HD Vector3<double> ball_middle(const PlacedMesh& mesh, const Vector3<double>& position) {
  return position + mesh.size * turned_with_mesh(mesh, mesh.tree.middle);
}

//! Converts a point to the unit and the axes of a mesh whose origin is at `position`.
ERGO_HD Vector3<double> in_mesh(const PlacedMesh& mesh, const Vector3<double>& position, const Vector3<double>& point) {
  const Vector3<double> d = (1.0 / mesh.size) * (point - position);
  const auto& rows = mesh.rows;
  return {rows[0][0] * d.x + rows[1][0] * d.y + rows[2][0] * d.z,
          rows[0][1] * d.x + rows[1][1] * d.y + rows[2][1] * d.z,
          rows[0][2] * d.x + rows[1][2] * d.y + rows[2][2] * d.z};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
