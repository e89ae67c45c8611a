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

//! Number of points of an edge table: with it, cubic interpolation is accurate to 1e-7 rad, even
//! for the flattened shadow of a rapidly rotating hole.
inline constexpr int edge_points = 1024;

//! Computes the shadow's edge [rad] at `count` position angles around a chart's center, in double
//! precision, on all CPU threads.
//!
//! `mirrored`: the edge is symmetric in γ, so that only half of it is computed.
std::vector<float> solve_edge(const CameraStation& camera, const ShadowChart& chart, int count, bool mirrored = false);

//! Returns the edge as kernels on the host read it; it points into `polar_angle`, which must not be
//! empty.
EdgeCurve edge_view(const ShadowChart& chart, const std::vector<float>& polar_angle);

//! Returns the maximum error [rad] of the shadow's edge as an observer sees it, if the edge is
//! interpolated in a table in the rain frame. Returns 0 for observers that move slowly relative to
//! that frame, and infinity if no edge is found at some position angle.
//!
//! Next to the horizon of an extremal hole, the whole sky of an observer that does not fall
//! corresponds to a small part of the rain frame's sky, and most of the observer's edge lies
//! between two points of the table. `to_rain`: from aberration_to_rain().
double edge_miss(const EdgeCurve& table, const CameraStation& observer, const Aberration& to_rain);

//! Caches the results of edge_miss() for the last two eyes, because each frame of a camera that
//! only turns or circles the spin axis needs the same one. of() returns 0 for spins up to 0.999,
//! where tables are accurate for all observers.
class EdgeMiss {
 public:
  double of(const EyeCamera& eye);

 private:
  struct Known {
    EyeCamera eye;
    double miss;
  };

  std::vector<Known> known_;  //!< cached results, the latest one last
};

//! Owns the table of a camera's shadow edge.
class EdgeTable {
 public:
  //! Computes the edge at `count` position angles and stores it in the backend's memory.
  EdgeTable(Backend backend, const CameraStation& camera, int count);

  //! Stores an edge that is already computed: polar angles [rad] at equal steps of the position
  //! angle around a chart's center.
  EdgeTable(Backend backend, const ShadowChart& chart, const std::vector<float>& polar_angle);

  //! Returns the table as kernels read it; `polar_angle` points into this object.
  [[nodiscard]] EdgeCurve view() const;

 private:
  EdgeCurve curve_{};
  Buffer<float> polar_angle_;
};

}  // namespace ergodome
