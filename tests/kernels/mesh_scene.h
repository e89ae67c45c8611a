#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "content/mesh/built_in_meshes.h"
#include "content/mesh/triangle_boxes.h"
#include "kernels/objects/mesh_rays.h"
#include "kernels/spacetime/kerr/camera_station.h"

// Small meshes with bounding-volume trees, for tests that trace rays to triangles.
namespace ergodome::test {

inline constexpr MeshLimits finest = {1e-15, 4000};

//! A mesh with its bounding-volume tree, placed in a scene.
struct Placed {
  TriangleBoxes boxes;
  PlacedMesh mesh;

  Placed(const TriangleMesh& triangles, const Vector3<double>& position, double size)
      : boxes(build_triangle_tree(triangles)),
        mesh{boxes.view(), position, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, size} {}
};

inline MeshHit first_hit(const CameraStation& camera, const Vector3<double>& n, const MeshScene& scene) {
  MeshHit hit;
  EXPECT_TRUE((trace_meshes<20, NearParts::azimuth_and_delay>(camera.spin, camera.cosine_phi, camera.sine_phi,
                                                              start_near_ray(camera, n), scene, finest, hit)));
  return hit;
}

//! Returns a triangle with two given sides, centered at the origin.
inline TriangleMesh triangle_about(const Vector3<double>& side, const Vector3<double>& other) {
  TriangleShape shape;
  shape.corners = {-1.0 * (side + other), 2.0 * side - other, 2.0 * other - side};
  return make_triangle(shape);
}

}  // namespace ergodome::test
