#pragma once

#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Points of an edge table: a cubic between them is good to 1e-7 rad even for the flattened shadow of a fast hole.
inline constexpr int edge_points = 1024;

//! Solves the shadow's edge at `count` position angles about a chart's centre, in double, on all CPU threads [rad].
//!
//! `mirrored`: the edge at -γ is that at γ, and only half is solved.
std::vector<float> solve_edge(const CameraStation& camera, const ShadowChart& chart, int count, bool mirrored = false);

//! The edge as kernels on the host read it; it points into `polar_angle`, which must not be empty.
EdgeCurve edge_view(const ShadowChart& chart, const std::vector<float>& polar_angle);

//! How far off an observer sees the shadow's edge, at the most, where a table of the rain frame has it [rad]; 0 for who moves so slowly past the
//! rain that all sees it as it is.
//!
//! Next to the horizon of an extremal hole an observer that does not fall sees but a corner of the rain's sky, and most of the edge between two points of a
//! table. `to_rain`: from aberration_to_rain().
double edge_miss(const EdgeCurve& table, const CameraStation& observer, const Aberration& to_rain);

//! The same for eyes in all grids of their places; 0 for spins of 0.999 and less, whose tables hold for all. What the last ones miss by is kept: a
//! camera that turns, or goes round the axis, is asked again for each picture.
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

//! Owns the shadow's edge of one camera as a table.
class EdgeTable {
 public:
  //! Solves the edge at `count` position angles and puts it where the backend's kernels read it.
  EdgeTable(Backend backend, const CameraStation& camera, int count);

  //! Takes an edge that was solved: polar angles at equal steps about a chart's centre [rad].
  EdgeTable(Backend backend, const ShadowChart& chart, const std::vector<float>& polar_angle);

  //! The table as kernels read it; `polar_angle` points into this object.
  [[nodiscard]] EdgeCurve view() const;

 private:
  EdgeCurve curve_{};
  Buffer<float> polar_angle_;
};

}  // namespace ergodome
