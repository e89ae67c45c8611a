#pragma once

#include "kernels/objects/mesh_search.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds the first mesh on each ray. Rays are followed backwards from a camera at azimuth φ, on all
//! ways round the hole. `hits`: one per lane. `active_at_start`: lanes to follow; the hits of all
//! others stay empty. Returns false in lanes that reached the step limit before they were decided.
//!
//! Paths are Taylor series. Pieces of a path that come near a mesh are approximated by parabolas to
//! select triangles. A crossing is then a zero of the series itself, so outlines are as exact as
//! the path. If a path crosses a triangle's plane twice within a fiftieth of the mesh's size, the
//! parabola decides. Retarded meshes move while light passes, if the delay is carried.
template <int Order, NearParts Parts, class T>
ERGO_HD MaskOf<T> trace_meshes(ScalarOf<T> spin, double cosine_phi, double sine_phi, const NearRay<T>& ray,
                               const MeshScene& scene, const MeshLimits& limits, const MaskOf<T>& active_at_start,
                               MeshHit* hits) {
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    hits[i] = MeshHit{};
  }
  return follow_path<Order, Parts>(spin, cosine_phi, sine_phi, ray, {scene.min_r, scene.max_r}, limits, active_at_start,
                                   [&](int i, const PathStep<Order, Parts, double>& step) {
                                     detail::StepSearch<Order, Parts> search = {step, scene, 0.0, {}};
                                     const bool found = search.run();
                                     if (found) {
                                       hits[i] = search.hit;
                                     }
                                     return found;
                                   });
}

//! Finds the first mesh on one ray; hit.mesh is -1 if there is none. Returns false if the ray
//! reached the step limit before the result was known.
template <int Order, NearParts Parts>
ERGO_HD bool trace_meshes(double spin, double cosine_phi, double sine_phi, const NearRay<double>& ray,
                          const MeshScene& scene, const MeshLimits& limits, MeshHit& hit) {
  return trace_meshes<Order, Parts, double>(spin, cosine_phi, sine_phi, ray, scene, limits, true, &hit);
}

}  // namespace ergodome::inline ERGO_TARGET
