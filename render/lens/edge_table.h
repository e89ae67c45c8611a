#pragma once

#include "kernels/metric/camera_station.h"
#include "kernels/shadow/edge_curve.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Owns the shadow's edge of one camera as a table.
class EdgeTable {
 public:
  //! Solves the edge at `count` position angles, in double, on all CPU threads, and puts it where the backend's kernels read it.
  EdgeTable(Backend backend, const CameraStation& camera, int count);

  //! The table as kernels read it; `polar_angle` points into this object.
  [[nodiscard]] EdgeCurve view() const;

 private:
  EdgeCurve curve_{};
  Buffer<float> polar_angle_;
};

}  // namespace ergodome
