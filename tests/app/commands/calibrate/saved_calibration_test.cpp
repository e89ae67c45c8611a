#include "app/commands/calibrate/saved_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "calibration/projectors/dome_pictures.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/error.h"
#include "tests/support/folder_test.h"
#include "tests/support/killed_writer.h"
#include "tests/support/simulated_dome.h"

namespace ergodome {
namespace {

class SavedCalibration : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    setup_ = test::calibrated_in(folder_, test::three(64), {256, 0.5});
    offsets_.resize(3);
    offsets_[1].right = {0.1, 0.05, 0.02, 0.0};
    offsets_[1].down = {0.0, -0.04, 0.03, 0.1};
  }

  [[nodiscard]] bool is_there(const char* name) const { return std::filesystem::exists(folder_ / name); }

  DomeSetup setup_;
  std::vector<GridOffsets> offsets_;
};

TEST_F(SavedCalibration, ShowsWhatTheCornersShowed) {
  setup_.rotation_deg = 20.0;
  std::vector<ProjectorPicture> before = projector_pictures(setup_);
  save_calibration(folder_ / "dome.toml", setup_, offsets_);
  const DomeSetup read = read_dome_setup(folder_ / "dome.toml");
  const std::vector<ProjectorPicture> after = projector_pictures(read);
  const WarpMesh wanted = moved_warp(offsets_[1], before[1].warp);
  ASSERT_EQ(after[1].warp.nodes.size(), wanted.nodes.size());
  for (std::size_t i = 0; i < wanted.nodes.size(); ++i) {
    if (wanted.nodes[i].valid) {
      EXPECT_NEAR(after[1].warp.nodes[i].x, wanted.nodes[i].x, 1e-5);
      EXPECT_NEAR(after[1].warp.nodes[i].y, wanted.nodes[i].y, 1e-5);
      EXPECT_NEAR(after[1].warp.nodes[i].u, wanted.nodes[i].u, 1e-5);
      EXPECT_NEAR(after[1].warp.nodes[i].v, wanted.nodes[i].v, 1e-5);
    }
  }
  const BlendMap mask = moved_mask(offsets_[1], before[1].blend);
  ASSERT_EQ(after[1].blend.values.size(), mask.values.size());
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    EXPECT_NEAR(after[1].blend.values[i], mask.values[i], 2e-5);
  }
}

TEST_F(SavedCalibration, TouchesOnlyProjectorsThatMoved) {
  const DomeSetup saved = save_calibration(folder_ / "dome.toml", setup_, offsets_);
  EXPECT_EQ(saved.projectors[0].warp->file, "p0.data");
  EXPECT_EQ(saved.projectors[1].warp->file, "2_p1.data");
  EXPECT_FALSE(is_there("1_p0.data"));
  EXPECT_TRUE(is_there("p1.data"));
}

TEST_F(SavedCalibration, KeepsOlderFiles) {
  const DomeSetup once = save_calibration(folder_ / "dome.toml", setup_, offsets_);
  EXPECT_FALSE(is_there("dome.toml.bak"));
  save_calibration(folder_ / "dome.toml", once, offsets_);
  EXPECT_TRUE(is_there("dome.toml.bak"));
  EXPECT_TRUE(is_there("2_p1.data.bak"));
  EXPECT_TRUE(is_there("2_p1_blend.png.bak"));
}

TEST_F(SavedCalibration, OfLensesAloneGetsWarpAndMask) {
  DomeSetup lenses = test::three(64);
  lenses.folder = folder_;
  save_calibration(folder_ / "dome.toml", lenses, offsets_);
  const DomeSetup read = read_dome_setup(folder_ / "dome.toml");
  EXPECT_FALSE(read.projectors[0].warp);
  ASSERT_TRUE(read.projectors[1].warp);
  EXPECT_EQ(read.projectors[1].blend_mask, "2_p1_blend.png");
}

TEST_F(SavedCalibration, WritesComputedFilesForAnotherTilt) {
  const DomePictures pictures(setup_);
  setup_.tilt_deg += 10.0;
  save_calibration(folder_ / "dome.toml", pictures.without_outdated(setup_), {{}, {}, {}}, pictures.outdated(setup_));
  const DomeSetup read = read_dome_setup(folder_ / "dome.toml");
  ASSERT_TRUE(read.projectors[2].warp);
  const ProjectorOptics optics(read, read.projectors[2]);
  const WarpMesh warp = projector_pictures(read)[2].warp;
  const WarpNode& node = warp.at(warp.columns / 2, warp.rows / 2);
  double u = 0.0;
  double v = 0.0;
  ASSERT_TRUE(master_position({25.0, 180.0}, *optics.dome_point({0.5, 0.5}), u, v));
  EXPECT_NEAR(node.u, u, 1e-5);
  EXPECT_NEAR(node.v, v, 1e-5);
}

TEST_F(SavedCalibration, LeavesFilesAloneAtTheSameTilt) {
  const DomePictures pictures(setup_);
  setup_.rotation_deg += 10.0;
  const DomeSetup saved = save_calibration(folder_ / "dome.toml", pictures.without_outdated(setup_), {{}, {}, {}},
                                           pictures.outdated(setup_));
  EXPECT_EQ(saved.projectors[2].warp->file, "p2.data");
  EXPECT_EQ(saved.projectors[2].blend_mask, "p2.png");
}

TEST_F(SavedCalibration, WritesNothingWhereOneFileCannotBeWritten) {
  offsets_[2] = offsets_[1];
  std::filesystem::create_directory(folder_ / "3_p2_blend.png");
  EXPECT_THROW(save_calibration(folder_ / "dome.toml", setup_, offsets_), Error);
  EXPECT_FALSE(is_there("2_p1.data"));
  EXPECT_FALSE(is_there("dome.toml"));
}

TEST_F(SavedCalibration, WithoutALiftHasNoMaskForIt) {
  setup_.projectors[0].black_level_mask = "p0.png";
  save_calibration(folder_ / "dome.toml", setup_, {{}, {}, {}});
  EXPECT_EQ(read_dome_setup(folder_ / "dome.toml").projectors[0].black_level_mask, "");
}

TEST_F(SavedCalibration, MovesMasksOfBlackLevelsToo) {
  setup_.projectors[1].black_level_mask = "p0.png";
  setup_.projectors[1].black_level_lift = {0.01, 0.02, 0.03};
  save_calibration(folder_ / "dome.toml", setup_, offsets_);
  const DomeSetup read = read_dome_setup(folder_ / "dome.toml");
  EXPECT_EQ(read.projectors[1].black_level_mask, "2_p1_black.png");
  EXPECT_EQ(read.projectors[1].black_level_lift.y, 0.02);
}

TEST_F(SavedCalibration, IsOldOrNewWhateverMomentTheProgramIsKilledIn) {
  save_calibration(folder_ / "dome.toml", setup_, offsets_);
  test::kill_while_writing(
      [&](int i) {
        DomeSetup turned = setup_;
        turned.rotation_deg = i % 90;
        save_calibration(folder_ / "dome.toml", turned, offsets_);
      },
      [&] { EXPECT_NO_THROW(projector_pictures(read_dome_setup(folder_ / "dome.toml"))); });
}

}  // namespace
}  // namespace ergodome
