#include "calibration/projectors/projector_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/projectors/dome_warp.h"
#include "kernels/core/angles.h"
#include "tests/support/errors.h"
#include "tests/support/simulated_dome.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

//! Returns the setup of a dome with a single projector, which shows the whole master upright, pixel
//! for pixel.
DomeSetup plain_dome() {
  DomeSetup setup;
  ProjectorSetup projector;
  projector.name = "one";
  projector.width_px = 1000;
  projector.height_px = 1000;
  setup.projectors.push_back(projector);
  return setup;
}

LoadedProjector square_warp(float minimum, float maximum) {
  WarpMesh mesh;
  mesh.columns = 2;
  mesh.rows = 2;
  mesh.nodes = {{0, 0, minimum, minimum}, {1, 0, maximum, minimum}, {0, 1, minimum, maximum}, {1, 1, maximum, maximum}};
  LoadedProjector loaded;
  loaded.warp = mesh;
  return loaded;
}

TEST(MasterWarp, IsTurnedToTheRight) {
  DomeSetup setup = plain_dome();
  LoadedProjector loaded = square_warp(0.0F, 1.0F);
  // After a rotation by 90°, the front of the master (its bottom) appears on the right. Therefore
  // the node on the right shows the bottom of the master.
  std::get<WarpMesh>(loaded.warp).at(1, 0) = {1.0F, 0.5F, 1.0F, 0.5F};
  setup.rotation_deg = 90.0;
  const WarpNode node = master_warp(setup, setup.projectors[0], loaded).at(1, 0);
  EXPECT_NEAR(node.u, 0.5, 1e-6);
  EXPECT_NEAR(node.v, 1.0, 1e-6);
}

TEST(MasterWarp, OfASurfaceFindsThePlacesOfItsPoints) {
  DomeSetup setup = plain_dome();
  setup.tilt_deg = 10.0;
  SurfaceMesh surface{9, 9, {}};
  for (int i = 0; i < 81; ++i) {
    // The surface is a patch in directions up and to the front; its points have different
    // distances.
    const double x = 0.1 * (i % 9 - 4);
    const int row = i / 9;
    const double z = -0.7 + 0.1 * (row - 4);
    const double far = 3.0 + 0.1 * i;
    surface.points.push_back({static_cast<float>(far * x), static_cast<float>(far), static_cast<float>(far * z)});
  }
  LoadedProjector loaded;
  loaded.warp = surface;
  const WarpMesh warp = master_warp(setup, setup.projectors[0], loaded);
  ASSERT_EQ(warp.columns, 11);  // includes the rim
  double u = 0.0;
  double v = 0.0;
  ASSERT_TRUE(master_position({10.0, 180.0}, {0.1, 1.0, -0.6}, u, v));
  const WarpNode& node = warp.at(1 + 5, 1 + 5);
  EXPECT_NEAR(node.x, 5.5 / 9.0, 1e-6);
  EXPECT_NEAR(node.u, u, 1e-5);
  EXPECT_NEAR(node.v, v, 1e-5);
}

TEST(MasterWarp, OfWhatALensShowsGoesThroughTheLens) {
  const DomeSetup setup = plain_dome();
  LoadedProjector loaded = square_warp(0.0F, 1.0F);
  loaded.source = WarpSource::lens_picture;
  loaded.orientation = {30.0, 40.0, 0.0};
  loaded.lens = Frustum{-20.0, 20.0, 20.0, -20.0};
  std::get<WarpMesh>(loaded.warp).at(0, 0) = {0.0F, 0.0F, 0.5F, 0.5F};  // on the axis: azimuth 30°, elevation 40°
  const WarpNode node = master_warp(setup, setup.projectors[0], loaded).at(0, 0);
  const double radius = 0.5 * 50.0 / 90.0;
  EXPECT_NEAR(node.u, 0.5 + radius * std::sin(pi / 6.0), 1e-5);
  EXPECT_NEAR(node.v, 0.5 + radius * std::cos(pi / 6.0), 1e-5);
}

TEST(MasterWarp, ThatShowsNothingIsRefused) {
  const DomeSetup setup = plain_dome();
  EXPECT_THAT(test::error_of([&] { master_warp(setup, setup.projectors[0], square_warp(3.0F, 4.0F)); }),
              HasSubstr("projector one: has a warp that shows no part of the domemaster"));
}

TEST(ProjectorPictures, NeedProjectors) {
  EXPECT_THAT(test::error_of([] { projector_pictures({}); }), HasSubstr("has no projectors"));
}

TEST(ProjectorPictures, ComeFromLensesAloneWithTheirBlend) {
  const auto pictures = projector_pictures(test::three(64));
  ASSERT_EQ(pictures.size(), 3U);
  for (const ProjectorPicture& picture : pictures) {
    EXPECT_EQ(picture.blend.width, 64);
    EXPECT_GT(picture.warp.columns, 2);
  }
}

ProjectorPicture picture_of(float max_u, int width_px) {
  ProjectorPicture picture;
  picture.width_px = width_px;
  picture.height_px = 1000;
  picture.warp = std::get<WarpMesh>(square_warp(0.0F, 1.0F).warp);
  for (WarpNode& node : picture.warp.nodes) {
    node.u *= max_u;
  }
  return picture;
}

TEST(EnoughMaster, HasAPixelForEachOfTheProjectors) {
  EXPECT_EQ(enough_master_px({picture_of(1.0F, 1000)}), 1024);
  EXPECT_EQ(enough_master_px({picture_of(0.5F, 1000)}), 2048);
  EXPECT_EQ(enough_master_px({picture_of(0.5F, 1500)}), 3008);
}

TEST(EnoughMaster, StaysWithinBounds) {
  EXPECT_EQ(enough_master_px({picture_of(1e-3F, 1000)}), 8192);
  EXPECT_EQ(enough_master_px({}), 256);
}

}  // namespace
}  // namespace ergodome
