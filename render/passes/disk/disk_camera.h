#pragma once

#include <vector>

#include "content/trajectory/disk_station.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "render/lens/stations/lens_position.h"

namespace ergodome {

//! Settings for building a disk grid.
struct DiskGridSettings {
  double inner_r = 6.0;  //!< inner edge of the disk [M]
  double outer_r = 20.0;
  //! True: the grid also stores azimuth and time, which the cloud pattern needs.
  bool pattern = false;
  double pixel = 1e-3;      //!< angle that a pixel of the screen subtends [rad]
  double budget_px = 0.25;  //!< maximum error of the disk's position on the screen [px]
  //! Aberration to the rain frame (aberration_to_rain()) of the observer whose screen is meant.
  Aberration observer{};
  //! Cells with a smaller area are not split: tracing their pixels costs less than tracing more
  //! nodes.
  double min_area_px = 3.0;
  //! Maximum number of nodes; when it is reached, cells that are still inaccurate are left to rays.
  int max_nodes = 1 << 16;
  //! True: the grid also stores the derivatives of nodes with respect to the camera's r and θ.
  bool derivatives = false;
  //! True: the grid also stores 1 / affine distance, for the stereo model `flat`.
  bool nearness = false;
};

//! Camera of a disk grid at Boyer-Lindquist (r, θ) [M, rad], with its chart. `camera` points into
//! this object.
struct DiskChartCamera {
  DiskChartCamera(Spacetime spacetime, const LensPosition& position, const DiskGridSettings& settings);
  DiskChartCamera(const DiskChartCamera&) = delete;
  DiskChartCamera& operator=(const DiskChartCamera&) = delete;

  CameraStation rain;
  //! True if the camera is on the equator: the sky at -γ then mirrors that at γ.
  bool mirrored;
  //! Polar angles α of the shadow's edge at equal steps of γ [rad]; the memory of `edge`.
  std::vector<float> polar_angle;
  EdgeCurve edge;
  DiskGridCamera camera;
};

//! Returns the part of the equatorial plane that a grid covers, and the smallest changes per pixel,
//! of 1/r and of azimuth, that are assumed when errors are converted to pixels: a tenth of the
//! changes for a disk that fills its apparent width evenly, seen from r.
DiskSpanOnScreen disk_span_on_screen(const DiskGridSettings& settings, double r);

//! Returns the limits of 1/r and of steps for tracing the rays of a disk grid; `inner_r` and
//! `outer_r` are the disk's edges [M]. The tolerance is not set.
LayerLimits<double> layer_limits(Spacetime spacetime, double inner_r, double outer_r);

}  // namespace ergodome
