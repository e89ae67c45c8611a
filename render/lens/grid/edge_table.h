#pragma once

#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"

// Tables of the shadow's edge.

namespace ergodome {

//! Points of an edge table: cubic interpolation is accurate to 1e-7 rad, even for the flattened
//! shadow of a rapidly rotating hole.
inline constexpr int edge_points = 1024;

//! Solves the shadow's edge [rad] at `count` position angles about a chart's center, in double, on
//! all CPU threads.
//!
//! `mirrored`: the edge is symmetric in γ, and only half of it is solved.
std::vector<float> solve_edge(const CameraStation& camera, const ShadowChart& chart, int count, bool mirrored = false);

//! Returns the edge as kernels on the host read it; it points into `polar_angle`, which must not be
//! empty.
EdgeCurve edge_view(const ShadowChart& chart, const std::vector<float>& polar_angle);

//! Returns the maximum error [rad] with which an observer sees the shadow's edge, if the edge comes
//! from a table in the rain frame; 0 for observers that move slowly relative to that frame.
//!
//! Next to the horizon of an extremal hole, an observer that does not fall sees a small corner of
//! the rain frame's sky, and most of the edge between two points of a table. `to_rain`: from
//! aberration_to_rain().
double edge_miss(const EdgeCurve& table, const CameraStation& observer, const Aberration& to_rain);

//! Caches edge_miss for the last eyes, as each frame of a camera that turns or circles the axis
//! needs it. Returns 0 for spins up to 0.999, where tables are accurate for all observers.
class EdgeMiss {
 public:
  double of(const EyeCamera& eye);

 private:
  struct Known {
    EyeCamera eye;
    double miss;
  };

  std::vector<Known> known_;  //!< the latest last
};

//! Owns a camera's shadow edge as a table.
class EdgeTable {
 public:
  //! Solves the edge at `count` position angles and stores it in the backend's memory.
  EdgeTable(Backend backend, const CameraStation& camera, int count);

  //! Stores an edge that is already solved: polar angles [rad] at equal steps about a chart's
  //! center.
  EdgeTable(Backend backend, const ShadowChart& chart, const std::vector<float>& polar_angle);

  //! Returns the table as kernels read it; `polar_angle` points into this object.
  [[nodiscard]] EdgeCurve view() const;

 private:
  EdgeCurve curve_{};
  Buffer<float> polar_angle_;
};

}  // namespace ergodome
