#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/shadow/critical_curve.h"

namespace ergodome {

//! A batch that computes the shadow's edge at `count` equal steps of the position angle about a
//! chart's center.
struct EdgeBatch {
  CameraStation camera;
  ShadowChart chart;
  int count;
  float* polar_angle;  //!< out: the edge's polar angle at each step [rad]
};

inline namespace ERGO_TARGET {

//! Computes one point of the shadow's edge, in double.
struct SolveEdge {
  EdgeBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr double full = 2.0 * 3.14159265358979323846;
    batch.polar_angle[index] =
        static_cast<float>(edge_polar_angle(batch.camera, batch.chart, full * index / batch.count));
  }
};

template <class T, class Action>
void dispatch(const EdgeBatch& batch, const Action& action) {
  action(SolveEdge{batch});
}

}  // namespace ERGO_TARGET
template <>
struct Kernel<EdgeBatch> : KernelDefaults {
  using Real = double;
  static constexpr bool wide = false;
  static constexpr bool counted = false;
  static const char* name(const EdgeBatch& /*batch*/) { return "solve_edge"; }
  static int elements(const EdgeBatch& batch) { return batch.count; }
};

}  // namespace ergodome
