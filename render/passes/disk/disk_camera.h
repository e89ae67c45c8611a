#pragma once

#include <vector>

#include "content/trajectory/disk_station.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "render/lens/stations/place_turn.h"

namespace ergodome {

//! Settings for building a disk grid.
struct DiskGridSettings {
  double inner_r = 6.0;  //!< edges of the disk [M]
  double outer_r = 20.0;
  bool pattern = false;        //!< include azimuth and time
  double pixel = 1e-3;         //!< angle of a pixel on the screen [rad]
  double budget_px = 0.25;     //!< maximum displacement on the screen [px]
  Aberration observer{};       //!< of the screen's observer: from aberration_to_rain()
  double least_area_px = 3.0;  //!< smaller cells are not split: tracing their pixels costs less than more nodes
  int most_nodes = 1 << 16;    //!< with this many nodes, cells that are still inaccurate are left to rays
  bool derivatives = false;    //!< include the derivatives of nodes along r and θ
  bool nearness = false;       //!< include 1 over the affine distance, for the stereo model `flat`
};

//! Camera of a disk grid at Boyer-Lindquist (r, θ) [M, rad], with its chart. `camera` points into
//! this object.
struct DiskChartCamera {
  DiskChartCamera(Spacetime spacetime, const LensPlace& place, const DiskGridSettings& settings);
  DiskChartCamera(const DiskChartCamera&) = delete;
  DiskChartCamera& operator=(const DiskChartCamera&) = delete;

  CameraStation rain;
  bool mirrored;                   //!< on the equator: the sky at -γ mirrors that at γ
  std::vector<float> polar_angle;  //!< of the shadow's edge
  EdgeCurve edge;
  DiskGridCamera camera;
};

//! Returns the part of the plane that a grid covers, and the smallest changes per pixel by which
//! its errors are measured: a tenth of those of a disk that spans its apparent width evenly, seen
//! from r.
DiskSpanOnScreen disk_span_on_screen(const DiskGridSettings& settings, double r);

//! Returns the limits up to which rays of a disk grid are followed. The tolerance is not set.
LayerLimits<double> layer_limits(Spacetime spacetime, double inner_r, double outer_r);

}  // namespace ergodome
