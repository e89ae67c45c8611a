#include "calibration/projectors/setup_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "calibration/formats/mpcdi/mpcdi_conversion.h"
#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "calibration/projectors/projector_files.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/warps/warp_conversion.h"
#include "tests/calibration/formats/mpcdi/mpcdi_fixtures.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

//! A Bourke mesh with u = x, v = y and full intensity, for a raster with the aspect ratio 2:1.
const std::string plain_mesh = "2\n2 2\n-2 -1 0 0 1\n2 -1 1 0 1\n-2 1 0 1 1\n2 1 1 1 1\n";

class SetupConversion : public FolderTest {
 protected:
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  //! Returns a setup with one projector of 8 x 4 pixels, whose table contains `lines`.
  [[nodiscard]] DomeSetup setup(const std::string& lines) const {
    const std::string head = "[dome]\nradius_m = 5\n[[projector]]\nname = \"P\"\nresolution_px = [8, 4]\n";
    return parse_dome_setup(head + lines, (folder_ / "dome.toml").string(), NamedFiles::must_exist);
  }
  LoadedProjector loaded(const std::string& lines) const {
    const DomeSetup with_lines = setup(lines);
    return load_projector(with_lines, with_lines.projectors[0]);
  }
};

TEST_F(SetupConversion, BourkeMeshIsReadWithTheAspectOfTheRaster) {
  write("a.data", plain_mesh);
  EXPECT_FLOAT_EQ(std::get<WarpMesh>(loaded("warp = \"a.data\"\n").warp).at(1, 0).x, 1.0F);
  const auto to_one = loaded("warp = { file = \"a.data\", x_range = \"one\" }\n");
  EXPECT_FLOAT_EQ(std::get<WarpMesh>(to_one.warp).at(1, 0).x, 1.5F);
}

TEST_F(SetupConversion, FloatMapIsContinuedToTheRim) {
  write("a.pfm", pfm_by_hand(2, 2, {0.25F, 0.75F, 0, 0.75F, 0.75F, 0, 0.25F, 0.25F, 0, 0.75F, 0.25F, 0}));
  const WarpMesh mesh = std::get<WarpMesh>(loaded("warp = \"a.pfm\"\n").warp);
  ASSERT_EQ(mesh.columns, 4);
  EXPECT_FLOAT_EQ(mesh.at(0, 0).u, 0.0F);
  EXPECT_FLOAT_EQ(mesh.at(3, 3).v, 1.0F);
}

TEST_F(SetupConversion, RegionOfACalibrationGivesWarpAndMasks) {
  write("a.mpcdi", zip_by_hand(media_members(media_xml)));
  const LoadedProjector projector = loaded("warp = { file = \"a.mpcdi\", region = \"right\" }\n");
  EXPECT_TRUE(std::holds_alternative<WarpMesh>(projector.warp));
  EXPECT_EQ(projector.blend->gamma_embedded, 1.0);
  EXPECT_EQ(projector.black_level->channels, 3);
  EXPECT_EQ(projector.black_level_lift.x, 1.0);
}

TEST_F(SetupConversion, RegionMustBeNamedWhereThereAreSeveral) {
  write("a.mpcdi", zip_by_hand(media_members(media_xml)));
  EXPECT_THAT(error_of([&] { loaded("warp = \"a.mpcdi\"\n"); }), HasSubstr("choose region from \"left\", \"right\""));
  EXPECT_THAT(error_of([&] { loaded("warp = { file = \"a.mpcdi\", region = \"top\" }\n"); }),
              HasSubstr("has no region \"top\""));
}

TEST_F(SetupConversion, PoseOfACalibrationStandsInForAMissingLens) {
  write("a.mpcdi.xml", lamps_xml);
  const LoadedProjector projector = loaded("warp = \"a.mpcdi.xml\"\n");
  EXPECT_EQ(std::get<Frustum>(projector.lens).left_deg, -25.0);
  EXPECT_EQ(projector.position_m.y, 3.0);
  EXPECT_EQ(projector.orientation.yaw_deg, 90.0);
}

TEST_F(SetupConversion, LensOfTheSetupComesBeforeThatOfACalibration) {
  write("a.mpcdi.xml", lamps_xml);
  const LoadedProjector projector = loaded("warp = \"a.mpcdi.xml\"\nfisheye = { fov_deg = 170 }\n");
  EXPECT_EQ(std::get<ProjectorFisheye>(projector.lens).field_of_view_deg, 170.0);
  EXPECT_EQ(projector.position_m.y, 0.0);
}

TEST_F(SetupConversion, MaskThatIsNoImageIsAnErrorWithItsName) {
  write("a.data", plain_mesh);
  write("a.png", "nothing");
  EXPECT_THAT(error_of([&] { loaded("warp = \"a.data\"\nblend_mask = \"a.png\"\n"); }),
              AllOf(HasSubstr("a.png"), HasSubstr("(blend_mask of "), HasSubstr("dome.toml:3, projector P)")));
}

TEST_F(SetupConversion, MaskOfAnotherShapeThanTheRasterIsAnError) {
  write("a.data", plain_mesh);
  write("a.png", png_by_hand(6, 6, 1, 8, std::vector<std::uint32_t>(36, 255)));
  EXPECT_THAT(error_of([&] { loaded("warp = \"a.data\"\nblend_mask = \"a.png\"\n"); }),
              HasSubstr("is a mask of 6 x 6 pixels, but the raster is 8 x 4"));
}

TEST_F(SetupConversion, WarpMaskAndLiftBecomeAMediaCalibration) {
  write("a.data", plain_mesh);
  write("a.png", png_by_hand(2, 2, 1, 8, {51, 51, 51, 51}));
  const DomeSetup flat =
      setup("warp = \"a.data\"\nblend_mask = \"a.png\"\nblend_mask_gamma = 2\nblack_level_lift = 0.2\n");
  const Mpcdi mpcdi = parsed_archive(to_mpcdi_archive(mpcdi_from_setup(flat, "2026-01-01 00:00:00"), "test"));
  EXPECT_EQ(mpcdi.profile, MpcdiProfile::media_2d);
  EXPECT_EQ(mpcdi.color_level, 3);
  const MpcdiRegion& region = mpcdi.buffers[0].regions[0];
  const WarpMesh warp = warp_of(mpcdi, region, "test");
  ASSERT_EQ(warp.columns, 8);
  for (const WarpNode& node : warp.nodes) {
    EXPECT_NEAR(node.u, node.x, 1e-6);
    EXPECT_NEAR(node.v, node.y, 1e-6);
  }
  EXPECT_NEAR(region.alpha->map.values[9], 0.04, 1.0 / 65535.0);  // (51 / 255)²
  EXPECT_NEAR(region.beta->map.values[0], 0.2, 1.0 / 65535.0);
  EXPECT_EQ(region.encode_gamma, 2.2);
}

TEST_F(SetupConversion, FlatLensesAloneBecomeShaderLampsAndComeBack) {
  const DomeSetup posed = setup(
      "position_m = [1, 2, 3]\nyaw_deg = 40\nfrustum = { left_deg = -9, right_deg = 8, up_deg = 7, down_deg = -6 }\n");
  const Mpcdi mpcdi = parsed_archive(to_mpcdi_archive(mpcdi_from_setup(posed, "2026-01-01 00:00:00"), "test"));
  EXPECT_EQ(mpcdi.profile, MpcdiProfile::shader_lamps);
  const DomeSetup again = setup_from_mpcdi(mpcdi, "a.mpcdi", 5.0);
  ASSERT_EQ(again.projectors.size(), 1U);
  const ProjectorSetup& projector = again.projectors[0];
  EXPECT_EQ(projector.position_m.x, 1.0);
  EXPECT_EQ(projector.position_m.y, 2.0);
  EXPECT_EQ(projector.position_m.z, 3.0);
  EXPECT_EQ(projector.orientation.yaw_deg, 40.0);
  EXPECT_EQ(std::get<Frustum>(projector.lens).down_deg, -6.0);
  EXPECT_FALSE(projector.warp);
}

//! Returns the picture of the setup's projector, and the warp of the MPCDI calibration that is made
//! from the setup.
std::pair<ProjectorPicture, WarpMesh> before_and_after(const DomeSetup& setup) {
  const Mpcdi mpcdi = parsed_archive(to_mpcdi_archive(mpcdi_from_setup(setup, "2026-01-01 00:00:00"), "test"));
  EXPECT_EQ(mpcdi.profile, MpcdiProfile::media_2d);
  return {projector_pictures(setup)[0], warp_of(mpcdi, mpcdi.buffers[0].regions[0], "test")};
}

//! Compares two warps at the nodes that both of them draw, which must be most nodes. Returns the
//! largest distance between the positions in the master that they show.
double farthest_apart(const WarpMesh& a, const WarpMesh& b) {
  const WarpMesh fine = resampled_warp(a, b.columns, b.rows);
  double farthest = 0.0;
  std::size_t both = 0;
  for (std::size_t i = 0; i < b.nodes.size(); ++i) {
    if (fine.nodes[i].valid && b.nodes[i].valid) {
      ++both;
      farthest = std::max({farthest, std::abs(static_cast<double>(fine.nodes[i].u) - b.nodes[i].u),
                           std::abs(static_cast<double>(fine.nodes[i].v) - b.nodes[i].v)});
    }
  }
  EXPECT_GT(2 * both, b.nodes.size());
  return farthest;
}

TEST_F(SetupConversion, AFisheyesWarpIsComputedForMpcdi) {
  const DomeSetup fisheye = setup("pitch_deg = 90\nfisheye = { fov_deg = 180, circle = 2 }\n");
  const auto [before, after] = before_and_after(fisheye);
  EXPECT_LT(farthest_apart(before.warp, after), 1e-6);
  // The projector points straight up at the zenith, so pixels on opposite sides of its center show
  // opposite points of the master.
  EXPECT_NEAR(after.at(3, 1).u + after.at(4, 2).u, 1.0, 1e-4);
  EXPECT_NEAR(after.at(3, 1).v + after.at(4, 2).v, 1.0, 1e-4);
}

TEST_F(SetupConversion, AMirrorsWarpIsComputedForMpcdi) {
  const DomeSetup mirrored = setup(
      "yaw_deg = 180\nfrustum = { left_deg = -10, right_deg = 10, up_deg = 12, down_deg = -3 }\n"
      "mirror = { position_m = [0, 0, 1.5], radius_m = 0.3 }\n");
  const auto [before, after] = before_and_after(mirrored);
  EXPECT_LT(farthest_apart(before.warp, after), 1e-6);
}

TEST_F(SetupConversion, ASetupsRotationIsInTheWarpsOfMpcdi) {
  write("a.data", plain_mesh);
  DomeSetup turned = setup("warp = \"a.data\"\n");
  turned.rotation_deg = 90.0;
  const WarpMesh warp = before_and_after(turned).second;
  for (const WarpNode& node : warp.nodes) {
    EXPECT_NEAR(node.u, 1.0F - node.y, 1e-6);
    EXPECT_NEAR(node.v, node.x, 1e-6);
  }
}

TEST_F(SetupConversion, CalibrationBecomesASetupThatReadsBack) {
  write("a.mpcdi", zip_by_hand(media_members(media_xml)));
  const DomeSetup made = setup_from_mpcdi(read_mpcdi(folder_ / "a.mpcdi"), "a.mpcdi", 6.0);
  write_dome_setup(folder_ / "dome.toml", made);
  const DomeSetup again = read_dome_setup(folder_ / "dome.toml");
  ASSERT_EQ(again.projectors.size(), 2U);
  EXPECT_EQ(again.projectors[1].warp->region, "right");
  EXPECT_EQ(again.projectors[1].output.window_x_px, 1920);
  EXPECT_EQ(again.projectors[0].gamma, 2.4);
  EXPECT_TRUE(std::holds_alternative<WarpMesh>(load_projector(again, again.projectors[0]).warp));
}

TEST(FisheyeOfACalibration, ReachesAsFarAsItGrows) {
  // The lens maps the angle t to the radius r = t - t³ / 3, which has its maximum at t = 1 rad.
  MpcdiRegion region;
  region.fisheye = MpcdiFisheye{0.1, 0.2, {1.0, -1.0 / 3.0, 0.0, 0.0}, 1.0, 0.0};
  const ProjectorFisheye lens = std::get<ProjectorFisheye>(lens_of(region));
  EXPECT_NEAR(lens.field_of_view_deg, 2.0 * 57.29577951, 0.21);
  EXPECT_EQ(lens.offset_y, 0.2);
}

}  // namespace
}  // namespace ergodome
