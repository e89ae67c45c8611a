#include "calibration/formats/mpcdi/mpcdi_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/warps/warp_conversion.h"
#include "tests/calibration/formats/mpcdi/mpcdi_fixtures.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using namespace test;
using testing::HasSubstr;

void expect_numbers(const Vector3<double>& v, double x, double y, double z) {
  EXPECT_NEAR(v.x, x, 1e-12);
  EXPECT_NEAR(v.y, y, 1e-12);
  EXPECT_NEAR(v.z, z, 1e-12);
}

Mpcdi lamps_with_surface(const std::string& profile, const std::string& unit) {
  std::string xml = replaced(lamps_xml, "<geometricUnit>m<", "<geometricUnit>" + unit + "<");
  xml = replaced(xml, "<path></path><interpolation>", "<path>surface.pfm</path><interpolation>");
  xml = replaced(xml, "profile=\"sl\"", "profile=\"" + profile + "\"");
  const std::string surface =
      pfm_by_hand(2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, unknown_sample, unknown_sample, unknown_sample});
  return parsed_archive(zip_by_hand({{"mpcdi.xml", xml}, {"surface.pfm", surface}}));
}

TEST(MpcdiConversion, UnitsCountInAnyCaseAndUnknownOnesAreErrors) {
  EXPECT_EQ(lamps_with_surface("sl", "CM").buffers[0].regions[0].geometry->unit, "cm");
  EXPECT_THAT(error_of([] { lamps_with_surface("sl", "furlong"); }), HasSubstr("furlong"));
  EXPECT_THAT(error_of([] { lamps_with_surface("a3", "furlong"); }), HasSubstr("furlong"));
  // Profile 3d has a lens and a flat warp, whose coordinates are not lengths; its unit is ignored.
  EXPECT_EQ(lamps_with_surface("3d", "furlong").buffers[0].regions[0].geometry->unit, "unknown");
}

TEST(MpcdiConversion, UnitsCountForThePlaceOfAProjectorWithoutAWarp) {
  const Mpcdi mpcdi =
      parsed_archive(zip_by_hand({{"mpcdi.xml", replaced(lamps_xml, "<geometricUnit>m<", "<geometricUnit>mm<")}}));
  ASSERT_FALSE(mpcdi.buffers[0].regions[0].geometry);
  // MPCDI gives this position with x to the right, y to the front and z up; the dome has z to the
  // back.
  expect_numbers(pose_of(mpcdi.buffers[0].regions[0]).position_m, 0.0015, 0.003, 0.002);
  EXPECT_TRUE(mpcdi.left_out.empty());
}

TEST(MpcdiConversion, LengthsWithoutAUnitAreToldToBeMetres) {
  EXPECT_THAT(lamps_with_surface("a3", "unknown").left_out,
              testing::ElementsAre(HasSubstr("no geometricUnit, so lengths are assumed to be in meters")));
}

TEST(MpcdiConversion, WarpOfTheFixedMediaProfileLooksUpTheWholeBuffer) {
  const Mpcdi mpcdi = parsed_media(media_xml);
  const WarpMesh left = warp_of(mpcdi, mpcdi.buffers[0].regions[0], "test");
  EXPECT_FLOAT_EQ(left.at(0, 0).u, 0.125F);  // 0 + 0.5 · 0.25
  EXPECT_FLOAT_EQ(left.at(0, 0).v, 0.25F);
  EXPECT_FLOAT_EQ(left.at(1, 1).u, 0.45F);
  EXPECT_FALSE(left.at(1, 0).valid);
  const WarpMesh right = warp_of(mpcdi, mpcdi.buffers[0].regions[1], "test");
  EXPECT_FLOAT_EQ(right.at(1, 1).u, 1.0F);   // 0.5 + 0.5 · 1
  EXPECT_FLOAT_EQ(right.at(1, 1).v, 0.75F);  // 0.25 + 0.5 · 1
}

TEST(MpcdiConversion, AxesOfASurveyorBecomeTheDomes) {
  // MPCDI gives (1.5, -2, 3) with x to the right, y to the front and z up: the projector is 1.5 m
  // to the right, 2 m to the back and 3 m up.
  const ProjectorPose pose = pose_of(parsed_lamps(lamps_xml).buffers[0].regions[0]);
  expect_numbers(pose.position_m, 1.5, 3.0, 2.0);
  expect_numbers(axes_of(pose.orientation).forward, 1, 0, 0);
}

TEST(MpcdiConversion, AxesOfOpenGlBecomeTheDomes) {
  // Christie's notes define these axes as y up and -z forward, which are also the axes of the dome.
  std::string xml = replaced(replaced(lamps_xml, "<yawy>0", "<yawy>-1"), "<yawz>-1", "<yawz>0");
  xml = replaced(replaced(xml, "<rolly>1", "<rolly>0"), "<rollz>0", "<rollz>-1");
  expect_numbers(pose_of(parsed_lamps(xml).buffers[0].regions[0]).position_m, 1.5, -2.0, 3.0);
}

TEST(MpcdiConversion, WithoutAFrameTheProjectorStandsAtTheOrigin) {
  MpcdiRegion region;
  region.orientation = Orientation{0, 90, 0};
  expect_numbers(pose_of(region).position_m, 0, 0, 0);
  expect_numbers(axes_of(pose_of(region).orientation).forward, 0, 1, 0);
}

TEST(MpcdiConversion, SurfaceOfShaderLampsIsTurnedByTheFrame) {
  const Mpcdi mpcdi = lamps_with_surface("sl", "cm");
  const SurfaceMesh surface = surface_of(mpcdi, mpcdi.buffers[0].regions[0], "test");
  ASSERT_EQ(surface.points.size(), 4U);
  // The first row of the file is the bottom row. Its point (1, 2, 3) cm is 1 cm to the right, 2 cm
  // to the front and 3 cm up.
  EXPECT_FLOAT_EQ(surface.points[2].x, 0.01F);
  EXPECT_FLOAT_EQ(surface.points[2].y, 0.03F);
  EXPECT_FLOAT_EQ(surface.points[2].z, -0.02F);
  EXPECT_TRUE(std::isnan(surface.points[1].x));
}

TEST(MpcdiConversion, SurfaceOfTheAdvancedProfileHasXToTheLeftAndZToTheFront) {
  const Mpcdi mpcdi = lamps_with_surface("a3", "ft");
  const SurfaceMesh surface = surface_of(mpcdi, mpcdi.buffers[0].regions[0], "test");
  EXPECT_FLOAT_EQ(surface.points[2].x, -0.3048F);
  EXPECT_FLOAT_EQ(surface.points[2].y, 0.6096F);
  EXPECT_FLOAT_EQ(surface.points[2].z, -0.9144F);
}

TEST(MpcdiConversion, WarpAndSurfaceAreNotTakenForOneAnother) {
  const Mpcdi flat = parsed_media(media_xml);
  const Mpcdi deep = lamps_with_surface("sl", "m");
  EXPECT_THAT(error_of([&] { surface_of(flat, flat.buffers[0].regions[0], "test"); }), HasSubstr("flat warp"));
  EXPECT_THAT(error_of([&] { warp_of(deep, deep.buffers[0].regions[0], "test"); }), HasSubstr("three dimensions"));
  const Mpcdi bare = parsed_lamps(lamps_xml);
  EXPECT_THAT(error_of([&] { surface_of(bare, bare.buffers[0].regions[0], "test"); }), HasSubstr("has no warp file"));
}

void expect_same_map(const FloatMap& map, const FloatMap& other) {
  ASSERT_EQ(map.width, other.width);
  ASSERT_EQ(map.samples.size(), other.samples.size());
  for (std::size_t i = 0; i < map.samples.size(); ++i) {
    EXPECT_TRUE(map.samples[i] == other.samples[i] || (std::isnan(map.samples[i]) && std::isnan(other.samples[i])));
  }
}

void expect_same_region(const MpcdiRegion& region, const MpcdiRegion& other) {
  EXPECT_EQ(region.id, other.id);
  EXPECT_EQ(region.x, other.x);
  EXPECT_EQ(region.height, other.height);
  EXPECT_EQ(region.resolution_y, other.resolution_y);
  EXPECT_EQ(region.decode_gamma, other.decode_gamma);
  EXPECT_EQ(region.encode_gamma, other.encode_gamma);
  ASSERT_EQ(region.geometry.has_value(), other.geometry.has_value());
  if (region.geometry) {
    expect_same_map(region.geometry->map, other.geometry->map);
    EXPECT_EQ(region.geometry->interpolation, other.geometry->interpolation);
  }
  ASSERT_EQ(region.alpha.has_value(), other.alpha.has_value());
  if (region.alpha) {
    EXPECT_EQ(region.alpha->map.values, other.alpha->map.values);
    EXPECT_EQ(region.alpha->gamma_embedded, other.alpha->gamma_embedded);
  }
  ASSERT_EQ(region.beta.has_value(), other.beta.has_value());
  if (region.beta) {
    EXPECT_EQ(region.beta->map.values, other.beta->map.values);
    EXPECT_EQ(region.beta->map.bit_depth, other.beta->map.bit_depth);
  }
}

TEST(MpcdiWriter, MediaCalibrationOfEitherVersionReadsBackTheSame) {
  for (const MpcdiVersion version : {MpcdiVersion::one, MpcdiVersion::two}) {
    Mpcdi mpcdi = parsed_media(media_xml);
    mpcdi.version = version;
    const Mpcdi again = parsed_archive(to_mpcdi_archive(mpcdi, "test"));
    EXPECT_EQ(again.version, version);
    EXPECT_EQ(again.geometry_level, 1);
    EXPECT_EQ(again.color_level, 3);
    EXPECT_EQ(again.date, mpcdi.date);
    EXPECT_EQ(again.buffers[0].resolution_x, 3840);
    for (std::size_t i = 0; i < 2; ++i) {
      expect_same_region(again.buffers[0].regions[i], mpcdi.buffers[0].regions[i]);
    }
  }
}

TEST(MpcdiWriter, GammasReadBackWhereTheyAreThereAndOnlyThere) {
  for (const std::optional<double> decode : {std::optional<double>(), std::optional(1.0), std::optional(1.8)}) {
    for (const std::optional<double> encode : {std::optional<double>(), std::optional(1.0), std::optional(2.4)}) {
      Mpcdi mpcdi = parsed_media(media_xml);
      mpcdi.buffers[0].regions[0].decode_gamma = decode;
      mpcdi.buffers[0].regions[0].encode_gamma = encode;
      const Mpcdi again = parsed_archive(to_mpcdi_archive(mpcdi, "test"));
      EXPECT_EQ(again.buffers[0].regions[0].decode_gamma, decode);
      EXPECT_EQ(again.buffers[0].regions[0].encode_gamma, encode);
    }
  }
}

TEST(MpcdiWriter, PosesAndLensesReadBackTheSame) {
  Mpcdi mpcdi = parsed_lamps(lamps_xml);
  MpcdiFisheye lens;
  lens.coefficients[0] = 0.6;
  lens.coefficients[1] = -0.01;
  lens.anamorphic_ratio = 1.2;
  mpcdi.buffers[0].regions[0].fisheye = lens;
  mpcdi.buffers[0].regions[0].distortion = FloatMap{2, 2, std::vector<float>(12, 0.5F)};
  const Mpcdi again = parsed_archive(to_mpcdi_archive(mpcdi, "test"));
  const MpcdiRegion& region = again.buffers[0].regions[0];
  expect_same_region(region, mpcdi.buffers[0].regions[0]);
  expect_numbers(pose_of(region).position_m, 1.5, 3.0, 2.0);
  EXPECT_EQ(region.orientation->yaw_deg, 90.0);
  EXPECT_EQ(region.frustum->left_deg, -25.0);
  EXPECT_EQ(region.fisheye->coefficients[1], -0.01);
  EXPECT_EQ(region.fisheye->anamorphic_ratio, 1.2);
  ASSERT_TRUE(region.distortion);
  expect_same_map(*region.distortion, *mpcdi.buffers[0].regions[0].distortion);
}

TEST(MpcdiWriter, SurfacesKeepUnitAndOrigin) {
  const Mpcdi again = parsed_archive(to_mpcdi_archive(lamps_with_surface("sl", "in"), "test"));
  EXPECT_EQ(again.buffers[0].regions[0].geometry->unit, "in");
  EXPECT_EQ(again.buffers[0].regions[0].geometry->origin, MpcdiOrigin::floor_centre);
}

TEST(MpcdiWriter, SameCalibrationMakesTheSameBytes) {
  EXPECT_EQ(to_mpcdi_archive(parsed_media(media_xml), "test"), to_mpcdi_archive(parsed_media(media_xml), "test"));
}

TEST(MpcdiWriter, RegionsThatLackSomethingAreErrors) {
  Mpcdi lamps = parsed_lamps(lamps_xml);
  lamps.buffers[0].regions[0].frame.reset();
  EXPECT_THAT(error_of([&] { to_mpcdi_archive(lamps, "test"); }), HasSubstr("without a coordinate frame"));
  Mpcdi media = parsed_media(media_xml);
  media.buffers[0].regions[1].id = "left";
  EXPECT_THAT(error_of([&] { to_mpcdi_archive(media, "test"); }), HasSubstr("a region with the id \"left\""));
  media.buffers[0].regions[0].geometry.reset();
  EXPECT_THAT(error_of([&] { to_mpcdi_archive(media, "test"); }), HasSubstr("without a warp"));
}

TEST(MpcdiWriter, BourkeMeshBecomesACalibrationAndComesBack) {
  // The mesh has u = x, v = y / 2 and intensities of 1 and 0.6; its raster has the aspect ratio
  // 2:1.
  const WarpMesh mesh =
      parse_bourke_mesh("2\n2 2\n-2 -1 0 0.5 1\n2 -1 1 0.5 0.6\n-2 1 0 1 1\n2 1 1 1 0.6\n", "a.data", 2.0);
  const Mpcdi mpcdi = media_calibration({region_from_warp("P", mesh, 1920, 960, 40, 20)}, "2026-01-01 00:00:00");
  const Mpcdi again = parsed_archive(to_mpcdi_archive(mpcdi, "test"));
  EXPECT_EQ(again.geometry_level, 2);
  const MpcdiRegion& region = again.buffers[0].regions[0];
  WarpMesh warp = warp_of(again, region, "test");
  multiply_intensity(warp, region.alpha->map, region.alpha->gamma_embedded);
  for (const WarpNode& node : warp.nodes) {
    EXPECT_NEAR(node.u, node.x, 1e-6);
    EXPECT_NEAR(node.v, 0.5 * node.y, 1e-6);
    EXPECT_NEAR(node.intensity, 1.0 - 0.4 * node.x, 1.0 / 65535.0);
  }
}

class MpcdiWriterFile : public FolderTest {};

TEST_F(MpcdiWriterFile, IsWrittenWholeAndReadBack) {
  write_mpcdi(folder_ / "wall.mpcdi", parsed_media(media_xml));
  EXPECT_EQ(read_mpcdi(folder_ / "wall.mpcdi").buffers[0].regions.size(), 2U);
}

}  // namespace
}  // namespace ergodome
