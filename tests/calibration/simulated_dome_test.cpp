#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "calibration/bourke_mesh.h"
#include "calibration/dome_blend.h"
#include "calibration/mpcdi_writer.h"
#include "calibration/projector_files.h"
#include "calibration/setup_conversion.h"
#include "kernels/core/error.h"
#include "tests/support/folder_test.h"
#include "tests/support/pi.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the fixtures of these tests

constexpr int master_px = 1024;

//! What a projector is fed, in linear light: a domemaster that holds its own coordinates, warped, and its brightness.
struct Frame {
  int width;
  int height;
  std::vector<float> light;
  std::vector<float> u;
  std::vector<float> v;

  //! Between pixels' middles, in proportion.
  [[nodiscard]] double read(const std::vector<float>& channel, const RasterPlace& place) const {
    const double x = std::clamp(place.x * width - 0.5, 0.0, width - 1.001);
    const double y = std::clamp(place.y * height - 0.5, 0.0, height - 1.001);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const double right = x - column;
    const double down = y - row;
    const auto at = [&](int i, int j) {
      return static_cast<double>(
          channel[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
    };
    return std::lerp(std::lerp(at(column, row), at(column + 1, row), right),
                     std::lerp(at(column, row + 1), at(column + 1, row + 1), right), down);
  }
};

//! The picture of a projector whose warp and mask are those of a setup's files.
Frame frame_of(const DomeSetup& setup, const ProjectorSetup& projector) {
  const LoadedProjector files = load_projector(setup, projector);
  Frame frame{projector.width_px, projector.height_px, {}, {}, {}};
  const WarpMesh warp = resampled_warp(std::get<WarpMesh>(files.warp), frame.width, frame.height);
  for (std::size_t i = 0; i < warp.nodes.size(); ++i) {
    const WarpNode& node = warp.nodes[i];
    const double mask = std::pow(static_cast<double>(files.blend->map.values[i]), files.blend->gamma_embedded);
    frame.light.push_back(node.valid ? node.intensity * static_cast<float>(mask) : 0.0F);
    frame.u.push_back(node.valid ? node.u : 0.5F);
    frame.v.push_back(node.valid ? node.v : 0.5F);
  }
  return frame;
}

//! A dome of 7 m with projectors about its middle that look outwards, and one that looks up if `cap`.
DomeSetup ring_of(int count, double half_width_deg, double up_deg, double pitch_deg, bool cap, int raster_px) {
  DomeSetup setup;
  setup.radius_m = 7.0;
  setup.tilt_deg = 15.0;
  const auto add = [&](const Vector3<double>& place, const Orientation& orientation, const Frustum& frustum) {
    ProjectorSetup projector;
    projector.name = "p";
    projector.name += std::to_string(setup.projectors.size());
    projector.position_m = place;
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

//! Throws frames onto the dome and looks at what is there.
class SimulatedDome : public FolderTest {
 protected:
  //! Computes warps and masks of a setup and writes them, as Bourke's meshes and PNG.
  [[nodiscard]] DomeSetup calibrated(DomeSetup setup) const {
    setup.folder = folder_;
    const DomeScreen screen = {setup.tilt_deg, 180.0};
    std::vector<ProjectorOptics> optics;
    for (const ProjectorSetup& projector : setup.projectors) {
      optics.emplace_back(setup, projector);
    }
    const DomeBlend blend(optics, screen, {});
    for (std::size_t i = 0; i < optics.size(); ++i) {
      ProjectorSetup& projector = setup.projectors[i];
      const double aspect = static_cast<double>(projector.width_px) / projector.height_px;
      std::ofstream(folder_ / (projector.name + ".data"))
          << to_bourke_mesh(dome_warp(optics[i], screen, master_px, 0.1), aspect);
      std::ofstream(folder_ / (projector.name + ".png"), std::ios::binary)
          << to_png(blend.mask(i, projector.width_px, projector.height_px), projector.name);
      projector.warp.emplace();
      projector.warp->file = projector.name + ".data";
      projector.blend_mask = projector.name + ".png";
    }
    return setup;
  }

  //! The same after a way through an MPCDI archive.
  [[nodiscard]] DomeSetup through_mpcdi(const DomeSetup& setup) const {
    const Mpcdi mpcdi = mpcdi_from_setup(setup, "2026-01-01 00:00:00");
    write_mpcdi(folder_ / "dome.mpcdi", mpcdi);
    DomeSetup with = setup;
    for (ProjectorSetup& projector : with.projectors) {
      projector.warp.emplace();
      projector.warp->file = "dome.mpcdi";
      projector.warp->format = WarpFormat::mpcdi;
      projector.warp->region = projector.name;
      projector.blend_mask.clear();
    }
    return with;
  }

  //! `optics`: the projectors as they stand; `files`: what they are fed.
  static void expect_master(const DomeSetup& optics, const DomeSetup& files) {
    std::vector<ProjectorOptics> projectors;
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < optics.projectors.size(); ++i) {
      projectors.emplace_back(optics, optics.projectors[i]);
      frames.push_back(frame_of(files, files.projectors[i]));
    }
    double least = 1e300;
    double most = 0.0;
    double farthest_px = 0.0;
    int overlaps = 0;
    constexpr int places = 20'000;
    for (int i = 0; i < places; ++i) {
      // Evenly over the hemisphere, but for the last half degree at its rim.
      const double up = 1.0 - (1.0 - std::sin(0.5 * pi / 180.0)) * (i + 0.5) / places;
      const double azimuth = 2.39996322972865332 * i;
      const double across = std::sqrt(1.0 - up * up);
      const double tilt = optics.tilt_deg * pi / 180.0;
      const Vector3<double> own = {across * std::sin(azimuth), up, -across * std::cos(azimuth)};
      const Vector3<double> point =
          optics.radius_m * Vector3<double>{own.x, std::cos(tilt) * own.y + std::sin(tilt) * own.z,
                                            std::cos(tilt) * own.z - std::sin(tilt) * own.y};
      double u = 0.0;
      double v = 0.0;
      ASSERT_TRUE(master_place({optics.tilt_deg, 180.0}, point, u, v));
      double light = 0.0;
      int lit = 0;
      for (std::size_t k = 0; k < projectors.size(); ++k) {
        const auto place = projectors[k].raster_place(point);
        const double own_light = place ? frames[k].read(frames[k].light, *place) : 0.0;
        if (own_light <= 0.0) {
          continue;
        }
        light += own_light / projectors[k].spread_m2(*place);
        if (own_light > 1e-3) {
          farthest_px = std::max(farthest_px, master_px * std::hypot(frames[k].read(frames[k].u, *place) - u,
                                                                     frames[k].read(frames[k].v, *place) - v));
          ++lit;
        }
      }
      overlaps += lit > 1 ? 1 : 0;
      least = std::min(least, light);
      most = std::max(most, light);
    }
    EXPECT_GT(overlaps, places / 20);
    EXPECT_LT(farthest_px, 0.5);
    EXPECT_GT(least, 0.0);
    EXPECT_LT(most / least, 1.01);
  }
};

DomeSetup three(int raster_px) { return ring_of(3, 74.0, 68.0, 42.0, false, raster_px); }

DomeSetup six(int raster_px) { return ring_of(5, 56.0, 38.0, 30.0, true, raster_px); }

TEST_F(SimulatedDome, ThreeProjectorsShowTheMaster) {
  const DomeSetup setup = calibrated(three(640));
  expect_master(setup, setup);
}

TEST_F(SimulatedDome, SixProjectorsShowTheMaster) {
  const DomeSetup setup = calibrated(six(640));
  expect_master(setup, setup);
}

TEST_F(SimulatedDome, ThreeProjectorsShowTheMasterAfterMpcdi) {
  const DomeSetup setup = calibrated(three(400));
  expect_master(setup, through_mpcdi(setup));
}

TEST_F(SimulatedDome, SixProjectorsShowTheMasterAfterMpcdi) {
  const DomeSetup setup = calibrated(six(320));
  expect_master(setup, through_mpcdi(setup));
}

TEST_F(SimulatedDome, AProjectorThatLooksAwayIsRefused) {
  DomeSetup setup = ring_of(1, 20.0, 10.0, -80.0, false, 400);
  std::get<Frustum>(setup.projectors[0].lens).down_deg = -10.0;
  const ProjectorOptics optics(setup, setup.projectors[0]);
  EXPECT_THROW(dome_warp(optics, {0.0, 180.0}, master_px, 0.1), Error);
  EXPECT_THROW(DomeBlend({optics}, {0.0, 180.0}, {}), Error);
}

}  // namespace
}  // namespace ergodome
