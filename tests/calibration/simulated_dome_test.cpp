#include "tests/support/simulated_dome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calibration/dome_blend.h"
#include "calibration/mpcdi_writer.h"
#include "calibration/projector_files.h"
#include "calibration/setup_conversion.h"
#include "kernels/core/error.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

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

//! Throws frames onto the dome and looks at what is there.
class SimulatedDome : public FolderTest {
 protected:
  [[nodiscard]] DomeSetup calibrated(const DomeSetup& setup) const {
    return calibrated_in(folder_, setup, {master_px, 0.1});
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
    constexpr int places = sanitized ? 2'000 : 20'000;
    for (int i = 0; i < places; ++i) {
      const Vector3<double> point = dome_point(optics, i, places);
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

constexpr const char* three_are_enough = "sanitizers see the same code with three";

TEST_F(SimulatedDome, ThreeProjectorsShowTheMaster) {
  const DomeSetup setup = calibrated(three(640));
  expect_master(setup, setup);
}

TEST_F(SimulatedDome, SixProjectorsShowTheMaster) {
  if (sanitized) {
    GTEST_SKIP() << three_are_enough;
  }
  const DomeSetup setup = calibrated(six(640));
  expect_master(setup, setup);
}

TEST_F(SimulatedDome, ThreeProjectorsShowTheMasterAfterMpcdi) {
  const DomeSetup setup = calibrated(three(400));
  expect_master(setup, through_mpcdi(setup));
}

TEST_F(SimulatedDome, SixProjectorsShowTheMasterAfterMpcdi) {
  if (sanitized) {
    GTEST_SKIP() << three_are_enough;
  }
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

//! The light of a setup's only projector.
DomeBlend blend_of(const std::string& projector, double evenness) {
  const DomeSetup setup = parse_dome_setup("[dome]\nradius_m = 7\n[[projector]]\nname = \"a\"\n" + projector,
                                           "dome.toml", NamedFiles::unchecked);
  return {{ProjectorOptics(setup, setup.projectors[0])}, {0.0, 180.0}, {2.0, evenness}};
}

//! The mean of its mask, and the greatest value.
std::pair<double, double> mask_of(const DomeBlend& blend) {
  const BlendMap mask = blend.mask(0, 128, 96);
  const double sum = std::accumulate(mask.values.begin(), mask.values.end(), 0.0);
  return {sum / static_cast<double>(mask.values.size()), *std::ranges::max_element(mask.values)};
}

TEST_F(SimulatedDome, LightThatPassesTheDomeByLeavesTheRestAsItIs) {
  const std::string beside =
      "position_m = [0, 0, 20]\nresolution_px = [640, 400]\nfrustum = { left_deg = -22, right_deg = 22, up_deg = 22, "
      "down_deg = -5 }\n";
  const auto [mean, most] = mask_of(blend_of(beside, 0.0));
  EXPECT_GT(mean, 0.4);
  EXPECT_EQ(most, 1.0);
  EXPECT_GT(mask_of(blend_of(beside, 1.0)).second, 0.7);
}

TEST_F(SimulatedDome, AMirrorsLightIsNoDarkerThanItHasToBe) {
  const auto [mean, most] =
      mask_of(blend_of("yaw_deg = 180\nfrustum = { left_deg = -10, right_deg = 10, up_deg = 12, down_deg = -3 "
                       "}\nmirror = { position_m = [0, 0, 1.5], radius_m = 0.3 }\n"
                       "resolution_px = [1400, 1050]\n",
                       1.0));
  EXPECT_GT(mean, 0.1);
  EXPECT_GT(most, 0.7);
}

}  // namespace
}  // namespace ergodome
