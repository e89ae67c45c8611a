#pragma once

#include <vector>

#include "content/trajectory/disk_station.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "render/lens/stations/place_turn.h"

namespace ergodome {

//! What a disk's grid is built for.
struct DiskGridSettings {
  double inner_r = 6.0;  //!< edges of the disk [M]
  double outer_r = 20.0;
  bool pattern = false;        //!< azimuth and time, too
  double pixel = 1e-3;         //!< angle of a pixel on the screen [rad]
  double budget_px = 0.25;     //!< greatest displacement on the screen
  Aberration observer{};       //!< whose screen: from aberration_to_rain()
  double least_area_px = 3.0;  //!< a cell smaller than this is not split: tracing its pixels is cheaper than its nodes
  int most_nodes = 1 << 16;    //!< what is bad still when there are so many is left to rays
  bool derivatives = false;    //!< the nodes' change along r and θ, too
  bool nearness = false;       //!< 1 over the affine distance, too, for the stereo model `flat`
};

//! A camera of a disk's grid at Boyer-Lindquist (r, θ) [M, rad], with its chart; `camera` points into it.
struct DiskChartCamera {
  DiskChartCamera(double spin, const LensPlace& place, const DiskGridSettings& settings);
  DiskChartCamera(const DiskChartCamera&) = delete;
  DiskChartCamera& operator=(const DiskChartCamera&) = delete;

  CameraStation rain;
  bool mirrored;                   //!< on the equator, the sky at -γ is that at γ
  std::vector<float> polar_angle;  //!< of the shadow's edge
  EdgeCurve edge;
  DiskGridCamera camera;
};

//! A tenth of what changes in a pixel of a disk that spans its apparent width evenly, seen from r, and the part of the plane that it takes.
DiskSpanOnScreen disk_span_on_screen(const DiskGridSettings& settings, double r);

//! How far rays of a disk's grid are followed; the tolerance is left open.
LayerLimits<double> layer_limits(double spin, double inner_r, double outer_r);

}  // namespace ergodome
