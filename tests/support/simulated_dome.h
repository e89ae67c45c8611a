#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/projectors/dome_blend.h"
#include "kernels/core/angles.h"

// A simulated dome with projectors, for tests.
namespace ergodome::test {

//! Returns the setup of a dome with a radius of 7 m and `count` projectors near its center, which
//! point outwards in all directions; if `cap`, another one points upwards.
inline DomeSetup ring_of(int count, double half_width_deg, double up_deg, double pitch_deg, bool cap, int raster_px) {
  DomeSetup setup;
  setup.radius_m = 7.0;
  setup.tilt_deg = 15.0;
  const auto add = [&](const Vector3<double>& position, const Orientation& orientation, const Frustum& frustum) {
    ProjectorSetup projector;
    projector.name = "p";
    projector.name += std::to_string(setup.projectors.size());
    projector.position_m = position;
    projector.orientation = orientation;
    projector.lens = frustum;
    projector.width_px = raster_px;
    projector.height_px = raster_px * 5 / 8;
    projector.output.window_x_px = raster_px * static_cast<int>(setup.projectors.size());
    setup.projectors.push_back(projector);
  };
  for (int i = 0; i < count; ++i) {
    const double yaw = 2.0 * pi * i / count;
    add({-0.8 * std::sin(yaw), 0.1 * i, 0.8 * std::cos(yaw)}, {360.0 * i / count, pitch_deg, 3.0 * i - 4.0},
        Frustum{-half_width_deg, half_width_deg, up_deg, -62.0});
  }
  if (cap) {
    add({0.2, 0.3, 0.1}, {20.0, 83.0, 0.0}, Frustum{-52.0, 54.0, 50.0, -50.0});
  }
  return setup;
}

inline DomeSetup three(int raster_px) { return ring_of(3, 74.0, 68.0, 42.0, false, raster_px); }

inline DomeSetup six(int raster_px) { return ring_of(5, 56.0, 38.0, 30.0, true, raster_px); }

struct WarpAccuracy {
  int master_px;
  double tolerance_px;
};

//! Computes the warps and masks of a setup and writes them to a folder, as Bourke meshes and PNG
//! images.
inline DomeSetup calibrated_in(const std::filesystem::path& folder, DomeSetup setup, const WarpAccuracy& accuracy) {
  setup.folder = folder;
  const DomeScreen screen = {setup.tilt_deg, 180.0};
  std::vector<ProjectorOptics> optics;
  optics.reserve(setup.projectors.size());
  for (const ProjectorSetup& projector : setup.projectors) {
    optics.emplace_back(setup, projector);
  }
  const DomeBlend blend(optics, screen, {});
  for (std::size_t i = 0; i < optics.size(); ++i) {
    ProjectorSetup& projector = setup.projectors[i];
    const double aspect = static_cast<double>(projector.width_px) / projector.height_px;
    std::ofstream(folder / (projector.name + ".data"))
        << to_bourke_mesh(dome_warp(optics[i], screen, accuracy.master_px, accuracy.tolerance_px), aspect);
    std::ofstream(folder / (projector.name + ".png"), std::ios::binary)
        << to_png(blend.mask(i, projector.width_px, projector.height_px), projector.name);
    projector.warp.emplace();
    projector.warp->file = projector.name + ".data";
    projector.blend_mask = projector.name + ".png";
  }
  return setup;
}

//! Returns point `i` [m] of `count` points that are spread evenly over the dome, except for half a
//! degree at its rim.
inline Vector3<double> dome_point(const DomeSetup& setup, int i, int count) {
  const double up = 1.0 - (1.0 - std::sin(0.5 * pi / 180.0)) * (i + 0.5) / count;
  const double azimuth = 2.39996322972865332 * i;
  const double across = std::sqrt(1.0 - up * up);
  const double tilt = setup.tilt_deg * pi / 180.0;
  const Vector3<double> own = {across * std::sin(azimuth), up, -across * std::cos(azimuth)};
  return setup.radius_m * Vector3<double>{own.x, std::cos(tilt) * own.y + std::sin(tilt) * own.z,
                                          std::cos(tilt) * own.z - std::sin(tilt) * own.y};
}

}  // namespace ergodome::test
