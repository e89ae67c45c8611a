#pragma once

#include "kernels/core/lanes.h"
#include "kernels/eyes/flat/affine_distances.h"
#include "kernels/spacetime/geodesic/affine_distance.h"

// Traces affine distances on the CPU.
namespace ergodome::inline ERGO_TARGET {

template <class T>
struct TraceAffineDistances {
  AffineDistanceBatch batch;

  void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const auto along = [&](int axis) { return load_lanes<T>(batch.direction[axis], first, batch.count); };
    const Vector3<T> n = {along(0), along(1), along(2)};
    store_lanes(batch.distance, first, batch.count, affine_distances(batch.camera, n, batch.r_end));
  }
};

template <class T, class Action>
void dispatch(const AffineDistanceBatch& batch, const Action& action) {
  action(TraceAffineDistances<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
