#include "tests/support/simulated_dome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calibration/formats/mpcdi/mpcdi_conversion.h"
#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/dome_pictures.h"
#include "calibration/projectors/projector_files.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/projectors/setup_conversion.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/error.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the fixtures of these tests

constexpr int master_px = 1024;

//! The frame that a projector receives, as linear light (`light`) and as coordinates in the master
//! (`u`, `v`) that each pixel shows.
struct Frame {
  int width;
  int height;
  std::vector<float> light;
  std::vector<float> u;
  std::vector<float> v;

  //! Interpolates one of the arrays linearly between pixel centers.
  [[nodiscard]] double read(const std::vector<float>& channel, const RasterPosition& position) const {
    const double x = std::clamp(position.x * width - 0.5, 0.0, width - 1.001);
    const double y = std::clamp(position.y * height - 0.5, 0.0, height - 1.001);
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

//! Returns the frame of a projector with a warp and a mask. `mask_gamma`: exponent that converts
//! values of the mask to linear light.
Frame frame_of(const ProjectorSetup& projector, const WarpMesh& mesh, const BlendMap& mask, double mask_gamma) {
  Frame frame{projector.width_px, projector.height_px, {}, {}, {}};
  const WarpMesh warp = resampled_warp(mesh, frame.width, frame.height);
  for (std::size_t i = 0; i < warp.nodes.size(); ++i) {
    const WarpNode& node = warp.nodes[i];
    const double linear = std::pow(static_cast<double>(mask.values[i]), mask_gamma);
    frame.light.push_back(node.valid ? node.intensity * static_cast<float>(linear) : 0.0F);
    frame.u.push_back(node.valid ? node.u : 0.5F);
    frame.v.push_back(node.valid ? node.v : 0.5F);
  }
  return frame;
}

//! Returns the frames of projectors, from the warp and mask files of a setup.
std::vector<Frame> frames_of(const DomeSetup& setup) {
  std::vector<Frame> frames;
  for (const ProjectorSetup& projector : setup.projectors) {
    const LoadedProjector files = load_projector(setup, projector);
    frames.push_back(
        frame_of(projector, std::get<WarpMesh>(files.warp), files.blend->map, files.blend->gamma_embedded));
  }
  return frames;
}

//! Returns the frames of projectors, from warps and masks that follow a setup's adjustments.
std::vector<Frame> frames_of(const DomeSetup& setup, const DomePictures& pictures) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < setup.projectors.size(); ++i) {
    const ProjectorPicture& picture = pictures.pictures()[i];
    frames.push_back(frame_of(setup.projectors[i], picture.warp, picture.blend, 1.0));
  }
  return frames;
}

//! Projects the frames of all projectors onto a simulated dome, and checks the result there.
class SimulatedDome : public FolderTest {
 protected:
  [[nodiscard]] DomeSetup calibrated(const DomeSetup& setup) const {
    return calibrated_in(folder_, setup, {master_px, 0.1});
  }

  //! Returns the setup after it was written to an MPCDI archive and read back.
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

  //! Checks that the dome shows the master. `optics` has the lenses and poses of the installed
  //! projectors, and `frames` their input. `max_off_px` is the tolerance in pixels of the master.
  static void expect_master(const DomeSetup& optics, const std::vector<Frame>& frames, double max_off_px = 0.5) {
    std::vector<ProjectorOptics> projectors;
    projectors.reserve(optics.projectors.size());
    for (const ProjectorSetup& projector : optics.projectors) {
      projectors.emplace_back(optics, projector);
    }
    double minimum = 1e300;
    double maximum = 0.0;
    double farthest_px = 0.0;
    int overlaps = 0;
    constexpr int positions = sanitized ? 2'000 : 20'000;
    for (int i = 0; i < positions; ++i) {
      const Vector3<double> point = dome_point(optics, i, positions);
      double u = 0.0;
      double v = 0.0;
      ASSERT_TRUE(master_position({optics.tilt_deg, 180.0}, point, u, v));
      double light = 0.0;
      int lit = 0;
      for (std::size_t k = 0; k < projectors.size(); ++k) {
        const auto position = projectors[k].raster_position(point);
        const double own_light = position ? frames[k].read(frames[k].light, *position) : 0.0;
        if (own_light <= 0.0) {
          continue;
        }
        light += own_light / projectors[k].spread_m2(*position);
        if (own_light > 1e-3) {
          farthest_px = std::max(farthest_px, master_px * std::hypot(frames[k].read(frames[k].u, *position) - u,
                                                                     frames[k].read(frames[k].v, *position) - v));
          ++lit;
        }
      }
      overlaps += lit > 1 ? 1 : 0;
      minimum = std::min(minimum, light);
      maximum = std::max(maximum, light);
    }
    EXPECT_GT(overlaps, positions / 20);
    EXPECT_LT(farthest_px, max_off_px);
    EXPECT_GT(minimum, 0.0);
    EXPECT_LT(maximum / minimum, 1.01);
  }
};

constexpr const char* three_are_enough = "sanitizers see the same code with three";

TEST_F(SimulatedDome, ThreeProjectorsShowTheMaster) {
  const DomeSetup setup = calibrated(three(640));
  expect_master(setup, frames_of(setup));
}

//! Compares a warp that was written to a file and read back with the original, at pixels that show
//! the master. Returns the largest error [px of the projector].
double farthest_off_px(const ProjectorPicture& meant, const WarpMesh& read) {
  const WarpMesh exact = resampled_warp(meant.warp, meant.width_px, meant.height_px);
  const WarpMesh found = resampled_warp(read, meant.width_px, meant.height_px);
  double farthest = 0.0;
  for (int row = 1; row + 1 < exact.rows; ++row) {
    for (int column = 1; column + 1 < exact.columns; ++column) {
      const WarpNode& node = exact.at(column, row);
      if (!node.valid || std::hypot(node.u - 0.5F, node.v - 0.5F) > 0.49F) {
        continue;
      }
      const WarpNode& there = found.at(column, row);
      EXPECT_TRUE(there.valid) << column << ' ' << row;
      const auto apart = [](const WarpNode& a, const WarpNode& b) { return std::hypot(a.u - b.u, a.v - b.v); };
      const double pixel = std::min(apart(exact.at(column - 1, row), exact.at(column + 1, row)),
                                    apart(exact.at(column, row - 1), exact.at(column, row + 1))) /
                           2.0;
      farthest = std::max(farthest, apart(node, there) / pixel);
    }
  }
  return farthest;
}

TEST_F(SimulatedDome, MpcdiHasFewSamplesAndIsWithinATenthOfAPixel) {
  const std::vector<ProjectorPicture> meant = projector_pictures(three(640), 0.02);
  const Mpcdi mpcdi = mpcdi_from_pictures(meant, "2026-01-01 00:00:00");
  write_mpcdi(folder_ / "dome.mpcdi", mpcdi);
  const Mpcdi read = read_mpcdi(folder_ / "dome.mpcdi");
  for (std::size_t i = 0; i < meant.size(); ++i) {
    const MpcdiRegion& region = read.buffers[0].regions[i];
    EXPECT_LE(region.geometry->map.width, (meant[i].width_px + 1) / 2);
    EXPECT_LE(region.geometry->map.height, (meant[i].height_px + 1) / 2);
    EXPECT_EQ(region.alpha->map.width, meant[i].width_px);
    EXPECT_LT(farthest_off_px(meant[i], with_rim(warp_of(read, region, "dome.mpcdi"))), 0.1) << region.id;
  }
}

//! Half of a projector's pixel, in pixels of the master: a projector has 400 pixels for 148
//! degrees.
constexpr double half_a_projector_pixel = 0.5 * (148.0 / 400.0) * (master_px / 180.0);

TEST_F(SimulatedDome, ComputedFilesFollowATilt) {
  DomeSetup setup = calibrated(three(400));
  DomePictures pictures(setup);
  setup.tilt_deg -= 9.0;
  EXPECT_TRUE(pictures.follow(setup, {{}, {}, {}}));
  EXPECT_FALSE(pictures.leaves_behind(setup));
  expect_master(setup, frames_of(setup, pictures), half_a_projector_pixel);
}

TEST_F(SimulatedDome, GainsOfProjectorsFollowTheirAdjustment) {
  DomeSetup setup = calibrated(three(400));
  DomePictures pictures(setup);
  setup.projectors[1].gain = {0.5, 0.625, 0.75};
  EXPECT_FALSE(pictures.follow(setup, {{}, {}, {}}));
  EXPECT_EQ(pictures.pictures()[1].gain.y, 0.625);
}

TEST_F(SimulatedDome, LensesAloneFollowATiltThereAndBack) {
  DomeSetup setup = three(400);
  DomePictures pictures(setup);
  for (const double tilt_deg : {60.0, 5.0}) {
    setup.tilt_deg = tilt_deg;
    pictures.follow(setup, {{}, {}, {}});
  }
  expect_master(setup, frames_of(setup, pictures), half_a_projector_pixel);
}

TEST_F(SimulatedDome, PreviewedMasksBecomeTheSameWhenTheyAreRefined) {
  DomeSetup setup = three(200);
  DomePictures whole(setup);
  DomePictures preview(setup, MaskDetail::preview);
  EXPECT_EQ(preview.pictures()[0].blend.width, 25);
  EXPECT_EQ(preview.refine_mask(), 0U);
  EXPECT_EQ(preview.pictures()[0].blend.values, whole.pictures()[0].blend.values);
  // The tilt changes after the first of three masks was refined.
  setup.tilt_deg += 20.0;
  EXPECT_TRUE(whole.follow(setup, {{}, {}, {}}));
  EXPECT_TRUE(preview.follow(setup, {{}, {}, {}}));
  EXPECT_EQ(preview.refine_mask(), 1U);
  EXPECT_EQ(preview.refine_mask(), 2U);
  EXPECT_EQ(preview.refine_mask(), std::nullopt);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(preview.pictures()[i].blend.width, 200) << i;
    EXPECT_EQ(preview.pictures()[i].blend.values, whole.pictures()[i].blend.values) << i;
  }
}

TEST_F(SimulatedDome, FilesOfAnOutsideCalibrationStayAfterATilt) {
  DomeSetup setup = calibrated(three(128));
  // Simulates a calibration by measurement: the projectors are aligned differently from the setup,
  // and the warp files contain the true alignment.
  for (ProjectorSetup& projector : setup.projectors) {
    projector.orientation.yaw_deg += 0.5;
  }
  DomePictures pictures(setup);
  const float u = pictures.pictures()[1].warp.at(7, 9).u;
  setup.tilt_deg += 9.0;
  EXPECT_FALSE(pictures.follow(setup, {{}, {}, {}})) << "masks stay, too";
  EXPECT_EQ(pictures.pictures()[1].warp.at(7, 9).u, u);
  EXPECT_TRUE(pictures.leaves_behind(setup));
}

TEST_F(SimulatedDome, ATiltThatLeavesAProjectorInTheDarkChangesNothing) {
  DomeSetup setup = ring_of(1, 20.0, 10.0, 20.0, false, 64);
  std::get<Frustum>(setup.projectors[0].lens).down_deg = -5.0;
  DomePictures pictures(setup);
  const float u = pictures.pictures()[0].warp.at(3, 3).u;
  setup.tilt_deg = -60.0;
  EXPECT_THROW(pictures.follow(setup, {{}}), Error);
  EXPECT_EQ(pictures.pictures()[0].warp.at(3, 3).u, u);
}

TEST_F(SimulatedDome, SixProjectorsShowTheMaster) {
  if (sanitized) {
    GTEST_SKIP() << three_are_enough;
  }
  const DomeSetup setup = calibrated(six(640));
  expect_master(setup, frames_of(setup));
}

TEST_F(SimulatedDome, ThreeProjectorsShowTheMasterAfterMpcdi) {
  const DomeSetup setup = calibrated(three(400));
  expect_master(setup, frames_of(through_mpcdi(setup)));
}

TEST_F(SimulatedDome, SixProjectorsShowTheMasterAfterMpcdi) {
  if (sanitized) {
    GTEST_SKIP() << three_are_enough;
  }
  const DomeSetup setup = calibrated(six(320));
  expect_master(setup, frames_of(through_mpcdi(setup)));
}

TEST_F(SimulatedDome, AProjectorThatLooksAwayIsRefused) {
  DomeSetup setup = ring_of(1, 20.0, 10.0, -80.0, false, 400);
  std::get<Frustum>(setup.projectors[0].lens).down_deg = -10.0;
  const ProjectorOptics optics(setup, setup.projectors[0]);
  EXPECT_THROW(dome_warp(optics, {0.0, 180.0}, master_px, 0.1), Error);
  EXPECT_THROW(DomeBlend({optics}, {0.0, 180.0}, {}), Error);
}

//! Computes the edge blend of a setup with a single projector, for a given evenness.
DomeBlend blend_of(const std::string& projector, double evenness) {
  const DomeSetup setup = parse_dome_setup("[dome]\nradius_m = 7\n[[projector]]\nname = \"a\"\n" + projector,
                                           "dome.toml", NamedFiles::unchecked);
  return {{ProjectorOptics(setup, setup.projectors[0])}, {0.0, 180.0}, {2.0, evenness}};
}

//! Returns the mean and the maximum of the mask of the only projector.
std::pair<double, double> mask_of(const DomeBlend& blend) {
  const BlendMap mask = blend.mask(0, 128, 96);
  const double sum = std::accumulate(mask.values.begin(), mask.values.end(), 0.0);
  return {sum / static_cast<double>(mask.values.size()), *std::ranges::max_element(mask.values)};
}

TEST_F(SimulatedDome, LightThatPassesTheDomeByLeavesTheRestAsItIs) {
  const std::string beside =
      "position_m = [0, -20, 0]\npitch_deg = 90\nresolution_px = [640, 400]\n"
      "frustum = { left_deg = -22, right_deg = 22, up_deg = 22, down_deg = -5 }\n";
  const auto [mean, maximum] = mask_of(blend_of(beside, 0.0));
  EXPECT_GT(mean, 0.4);
  EXPECT_EQ(maximum, 1.0);
  EXPECT_GT(mask_of(blend_of(beside, 1.0)).second, 0.7);
}

TEST_F(SimulatedDome, AMirrorsLightIsNoDarkerThanItHasToBe) {
  const auto [mean, maximum] =
      mask_of(blend_of("yaw_deg = 180\nfrustum = { left_deg = -10, right_deg = 10, up_deg = 12, down_deg = -3 "
                       "}\nmirror = { position_m = [0, 0, 1.5], radius_m = 0.3 }\n"
                       "resolution_px = [1400, 1050]\n",
                       1.0));
  EXPECT_GT(mean, 0.1);
  EXPECT_GT(maximum, 0.7);
}

}  // namespace
}  // namespace ergodome
