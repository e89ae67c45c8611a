#pragma once

#include "kernels/spacetime/shadow/critical_curve.h"

namespace ergodome {

//! A batch that computes the shadow's edge at `count` equal steps of the position angle about a
//! chart's center.
struct EdgeBatch {
  CameraStation camera;
  ShadowChart chart;
  int count;
  float* polar_angle;  //!< [rad]
};

inline namespace ERGO_TARGET {

//! Solves one point of the edge, in double.
struct SolveEdge {
  EdgeBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr double full = 2.0 * 3.14159265358979323846;
    batch.polar_angle[index] =
        static_cast<float>(edge_polar_angle(batch.camera, batch.chart, full * index / batch.count));
  }
};

}  // namespace ERGO_TARGET
}  // namespace ergodome
