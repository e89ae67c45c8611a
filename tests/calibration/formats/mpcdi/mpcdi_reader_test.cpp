#include "calibration/formats/mpcdi/mpcdi_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/calibration/formats/mpcdi/mpcdi_fixtures.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::AllOf;
using testing::HasSubstr;

std::string media_problem(const std::string& from, const std::string& to) {
  return error_of([&] { parsed_media(replaced(media_xml, from, to)); });
}

std::string lamps_problem(const std::string& from, const std::string& to) {
  return error_of([&] { parsed_lamps(replaced(lamps_xml, from, to)); });
}

void expect_media(const Mpcdi& mpcdi) {
  EXPECT_EQ(mpcdi.profile, MpcdiProfile::media_2d);
  ASSERT_EQ(mpcdi.buffers.size(), 1U);
  ASSERT_EQ(mpcdi.buffers[0].regions.size(), 2U);
  const MpcdiRegion& left = mpcdi.buffers[0].regions[0];
  const MpcdiRegion& right = mpcdi.buffers[0].regions[1];
  EXPECT_EQ(left.id, "left");
  EXPECT_EQ(left.resolution_x, 1920);
  EXPECT_EQ(left.resolution_y, 1080);
  EXPECT_EQ(right.y, 0.25);
  EXPECT_EQ(right.width, 0.5);
  EXPECT_EQ(right.height, 0.5);
  ASSERT_TRUE(left.geometry && left.alpha && left.beta);
  EXPECT_FLOAT_EQ(left.geometry->map.samples[0], 0.25F);
}

TEST(Mpcdi, OfVersionTwoIsReadAsTheSpecificationSpellsIt) {
  const Mpcdi mpcdi = parsed_media(media_xml);
  expect_media(mpcdi);
  EXPECT_EQ(mpcdi.version, MpcdiVersion::two);
  EXPECT_EQ(mpcdi.geometry_level, 1);
  EXPECT_EQ(mpcdi.color_level, 3);
  EXPECT_EQ(mpcdi.date, "2015-03-01 12:00:00");
  EXPECT_EQ(mpcdi.buffers[0].resolution_x, 3840);
}

TEST(Mpcdi, OfVersionOneHasALevelAndTheLibrarysSpelling) {
  std::string xml = replaced(media_xml, "geometry=\"1\" color=\"3\"", "level=\"4\"");
  xml = replaced(replaced(xml, "version=\"2.0\"", "version=\"1.0\""), "xResolution", "Xresolution");
  xml = replaced(replaced(replaced(xml, "yResolution", "Yresolution"), "xSize", "xsize"), "ySize", "ysize");
  const Mpcdi mpcdi = parsed_media(xml);
  expect_media(mpcdi);
  EXPECT_EQ(mpcdi.version, MpcdiVersion::one);
  EXPECT_EQ(mpcdi.geometry_level, 2);
  EXPECT_EQ(mpcdi.color_level, 3);
}

TEST(Mpcdi, NamesMayBeWrittenInCapitals) {
  std::string capitals = media_xml;
  bool value = false;
  bool tag = false;
  for (char& c : capitals) {
    tag = c == '<' || (tag && c != '>');
    value = c == '"' ? !value : value;
    const bool declaration = &c < &capitals[capitals.find('\n')];
    c = tag && !value && !declaration && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  ASSERT_THAT(capitals, HasSubstr("<GEOMETRYWARPFILE>"));
  expect_media(parsed_media(capitals));
}

TEST(Mpcdi, ValuesKeepTheirCapitals) {
  EXPECT_THAT(media_problem("profile=\"2d\"", "profile=\"2D\""), HasSubstr("profile \"2D\""));
  EXPECT_THAT(media_problem("fileset region=\"left\"", "fileset region=\"Left\""), HasSubstr("region \"Left\""));
}

TEST(Mpcdi, DescriptionMayBeCalledMpacs) {
  auto members = media_members(media_xml);
  members[0].name = "MPACS.xml";
  expect_media(parsed_archive(zip_by_hand(members)));
}

TEST(Mpcdi, FilesetsMayStandBesideFiles) {
  std::string xml = replaced(replaced(media_xml, "<files>", "<files/>"), "</files>", "");
  expect_media(parsed_media(xml));
}

TEST(Mpcdi, UnitsOfCoordinatesOnAScreenMeanNothing) {
  for (const char* const unit : {"2d", "furlong", "MM"}) {
    const std::string named = std::string("<geometricUnit>") + unit + "</geometricUnit><interpolation>linear";
    expect_media(parsed_media(replaced(media_xml, "<interpolation>linear", named)));
  }
}

TEST(Mpcdi, FilesetsMayStandInTheirRegion) {
  // Some programs write no id in the fileset, and the path as the text of its element.
  const std::string xml = R"(<MPCDI profile="2d" version="2.0"><display><buffer Xresolution="1920" Yresolution="1080">
    <region id="r" x="0" y="0" xsize="1" ysize="1" xresolution="1920" yresolution="1080"><frame x="0" y="0"/><fileset>
    <geometryWarpFile>left.pfm<interpolationMethod>linear</interpolationMethod></geometryWarpFile>
    <alphaMap><path>left.png</path></alphaMap></fileset></region></buffer></display></MPCDI>)";
  const Mpcdi mpcdi = parsed_media(xml);
  const MpcdiRegion& region = mpcdi.buffers.at(0).regions.at(0);
  ASSERT_TRUE(region.geometry);
  EXPECT_EQ(region.geometry->interpolation, "linear");
  EXPECT_TRUE(region.alpha);
  EXPECT_THAT(error_of([&] { parsed_media(replaced(xml, "<fileset>", "<fileset region=\"s\">")); }),
              HasSubstr("names region \"s\""));
}

TEST(Mpcdi, PathsMayHaveBackslashes) {
  EXPECT_EQ(media_problem("<path>left.pfm</path>", "<path>.\\left.pfm</path>"), "");
  EXPECT_THAT(media_problem("<path>left.pfm</path>", "<path>..\\left.pfm</path>"), HasSubstr("../left.pfm"));
  EXPECT_THAT(media_problem("<path>left.pfm</path>", "<path>C:\\left.pfm</path>"), HasSubstr("C:/left.pfm"));
}

TEST(Mpcdi, MembersAreFoundWithoutRegardToCapitals) {
  auto members = media_members(media_xml);
  members[1].name = "LEFT.PFM";
  expect_media(parsed_archive(zip_by_hand(members)));
}

TEST(Mpcdi, MembersMayBeNamedWithBackslashes) {
  auto members = media_members(replaced(media_xml, "<path>left.pfm</path>", "<path>maps\\left.pfm</path>"));
  members[1].name = "maps\\left.pfm";
  expect_media(parsed_archive(zip_by_hand(members)));
}

TEST(Mpcdi, RowsOfMapsFollowTheOrderAskedFor) {
  const std::string bytes = zip_by_hand(media_members(media_xml));
  EXPECT_FLOAT_EQ(parsed_archive(bytes).buffers[0].regions[0].geometry->map.samples[0], 0.25F);
  EXPECT_FLOAT_EQ(parsed_archive(bytes, RowOrder::top_down).buffers[0].regions[0].geometry->map.samples[0], 0.1F);
}

TEST(Mpcdi, MasksOfEightAndSixteenBitsAndOneAndThreeComponentsAreRead) {
  const Mpcdi mpcdi = parsed_media(media_xml);
  const MpcdiRegion& left = mpcdi.buffers[0].regions[0];
  EXPECT_EQ(left.alpha->map.channels, 1);
  EXPECT_EQ(left.alpha->gamma_embedded, 2.2);
  EXPECT_NEAR(left.alpha->map.values[1], 0.2, 1e-6);
  EXPECT_NEAR(left.alpha->map.values[3], 1.0, 1e-6);
  EXPECT_EQ(left.beta->map.channels, 3);
  EXPECT_EQ(left.beta->map.bit_depth, 16);
  EXPECT_NEAR(left.beta->map.values[9], 1.0, 1e-6);
  EXPECT_NEAR(left.beta->map.values[10], 0.2, 1e-6);
}

TEST(Mpcdi, GammasAreReadAsAttributeAndAsElement) {
  const Mpcdi mpcdi = parsed_media(media_xml);
  EXPECT_EQ(mpcdi.buffers[0].regions[0].decode_gamma, 2.2);
  EXPECT_EQ(mpcdi.buffers[0].regions[0].encode_gamma, 2.4);
  EXPECT_EQ(mpcdi.buffers[0].regions[1].decode_gamma, std::nullopt);
}

TEST(Mpcdi, TablesOfColoursAreNotedAsLeftOut) {
  const Mpcdi mpcdi = parsed_media(replaced(media_xml, "correct type=\"none\"", "correct type=\"lut3d\""));
  ASSERT_EQ(mpcdi.left_out.size(), 1U);
  EXPECT_THAT(mpcdi.left_out[0], AllOf(HasSubstr("mpcdi.xml:8"), HasSubstr("lut3d")));
}

TEST(Mpcdi, ShaderLampsTellWhereProjectorsStandWithoutAnyFile) {
  const Mpcdi mpcdi = parsed_lamps(lamps_xml);
  const MpcdiRegion& region = mpcdi.buffers[0].regions[0];
  EXPECT_EQ(mpcdi.profile, MpcdiProfile::shader_lamps);
  EXPECT_EQ(region.orientation->yaw_deg, 90.0);
  EXPECT_EQ(region.frustum->left_deg, -25.0);
  EXPECT_EQ(region.frustum->up_deg, 20.0);
  EXPECT_EQ(region.frame->position.y, -2.0);
  EXPECT_EQ(region.frame->yaw_axis.z, -1.0);
  EXPECT_FALSE(region.geometry || region.alpha || region.distortion);
}

TEST(Mpcdi, FisheyeLensOfTheBufferExtensionIsRead) {
  const std::string extension = R"(<extensionSet><extension Name="BufferExtension" hasExternalFiles="false">
    <buffer id="dome"><region id="P1"><fisheye><horizontalOffset>0.2</horizontalOffset><verticalOffset>-0.1</verticalOffset>
    <f1>0.29907</f1><f3>-0.00023</f3></fisheye><anamorphic><angle>0.01</angle><ratio>1.2</ratio></anamorphic>
    </region></buffer></extension></extensionSet></MPCDI>)";
  // For a fisheye lens, the frustum has no meaning. Files of Christie's contain these angles.
  const std::string xml = replaced(replaced(lamps_xml, "<leftAngle>-25", "<leftAngle>90"), "</MPCDI>", extension);
  const MpcdiRegion region = parsed_lamps(xml).buffers[0].regions[0];
  ASSERT_TRUE(region.fisheye);
  EXPECT_EQ(region.fisheye->coefficients[0], 0.29907);
  EXPECT_EQ(region.fisheye->coefficients[3], 0.0);
  EXPECT_EQ(region.fisheye->vertical_offset, -0.1);
  EXPECT_EQ(region.fisheye->anamorphic_ratio, 1.2);
}

TEST(Mpcdi, OriginThatIsNoOriginCountsAsUnknown) {
  // VESA's library writes the name of the interpolation into this tag, and spells the tag with a
  // lowercase o.
  const std::string xml = replaced(replaced(lamps_xml, "floorCenter", "linear"), "originOf3DData", "originof3DData");
  EXPECT_EQ(parsed_lamps(xml).profile, MpcdiProfile::shader_lamps);
}

TEST(Mpcdi, ProfilesNeedTheirParts) {
  EXPECT_THAT(lamps_problem("coordinateFrame", "frame"), HasSubstr("has no <coordinateFrame>"));
  EXPECT_THAT(lamps_problem("frustum>", "view>"), AllOf(HasSubstr("test.mpcdi.xml:5"), HasSubstr("has no <frustum>")));
  EXPECT_THAT(media_problem("left.pfm", ""), HasSubstr("names no warp"));
  EXPECT_THAT(media_problem("geometryWarpFile", "warpFile"), HasSubstr("has no <geometryWarpFile>"));
  EXPECT_THAT(lamps_problem("</buffer>", "</buffer><buffer id=\"b\"></buffer>"), HasSubstr("second buffer"));
}

TEST(Mpcdi, MissingMaskIsAnError) {
  auto members = media_members(media_xml);
  members.erase(members.begin() + 3);
  EXPECT_THAT(error_of([&] { parsed_archive(zip_by_hand(members)); }),
              AllOf(HasSubstr("test.mpcdi: left.png"), HasSubstr("is not in the archive")));
  EXPECT_THAT(media_problem("alphaMap", "alpha"), HasSubstr("has no <alphaMap>"));
  EXPECT_THAT(media_problem("betaMap", "beta"), HasSubstr("has no <betaMap>"));
}

TEST(Mpcdi, FrustumTurnedInsideOutIsAnError) {
  EXPECT_THAT(lamps_problem("<leftAngle>-25", "<leftAngle>31"), HasSubstr("impossible frustum"));
  EXPECT_THAT(lamps_problem("<upAngle>20", "<upAngle>90"), HasSubstr("impossible frustum"));
}

TEST(Mpcdi, FrameWithoutRightAnglesIsAnError) {
  EXPECT_THAT(lamps_problem("<pitchy>0", "<pitchy>0.1"), HasSubstr("right angles"));
}

TEST(Mpcdi, NumbersThatAreNoneAreErrorsWithTheirLine) {
  EXPECT_THAT(lamps_problem("<yaw>90", "<yaw>nan"), AllOf(HasSubstr("test.mpcdi.xml:6"), HasSubstr("yaw = \"nan\"")));
  EXPECT_THAT(lamps_problem("<yaw>90", "<yaw>90,5"), HasSubstr("90,5"));
  EXPECT_THAT(lamps_problem("xResolution=\"1400\"", "xResolution=\"-1400\""), HasSubstr("-1400"));
  EXPECT_THAT(lamps_problem("xResolution=\"1400\"", "xResolution=\"99999999999\""), HasSubstr("99999999999"));
  EXPECT_THAT(media_problem("xSize=\"0.5\" ySize=\"1\"", "xSize=\"-0.5\" ySize=\"1\""), HasSubstr("within its buffer"));
  EXPECT_THAT(media_problem("x=\"0.5\"", "x=\"0.75\""), HasSubstr("within its buffer"));
}

TEST(Mpcdi, RegionsWithOneIdAreAnError) {
  EXPECT_THAT(media_problem("id=\"right\"", "id=\"left\""), HasSubstr("id \"left\""));
}

TEST(Mpcdi, UnknownVersionsAreErrors) {
  EXPECT_THAT(media_problem("version=\"2.0\"", "version=\"3.0\""), HasSubstr("version 3"));
}

class MpcdiFile : public FolderTest {
 protected:
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  void write_media(const std::string& xml) const {
    for (const ZipMember& member : media_members(xml)) {
      write(member.name == "mpcdi.xml" ? "wall.mpcdi.xml" : member.name, member.bytes);
    }
  }
  [[nodiscard]] std::string problem() const {
    return error_of([&] { read_mpcdi(folder_ / "wall.mpcdi.xml"); });
  }
};

TEST_F(MpcdiFile, IsReadAsAnArchive) {
  write("wall.mpcdi", zip_by_hand(media_members(media_xml)));
  expect_media(read_mpcdi(folder_ / "wall.mpcdi"));
}

TEST_F(MpcdiFile, WithoutAnArchiveHasItsFilesBesideIt) {
  write_media(media_xml);
  expect_media(read_mpcdi(folder_ / "wall.mpcdi.xml"));
}

TEST_F(MpcdiFile, FilesBesideItAreFoundWithoutRegardToCapitals) {
  write_media(replaced(media_xml, "<path>left.pfm</path>", "<path>Maps\\Left.PFM</path>"));
  std::filesystem::create_directory(folder_ / "maps");
  std::filesystem::rename(folder_ / "left.pfm", folder_ / "maps" / "left.pfm");
  expect_media(read_mpcdi(folder_ / "wall.mpcdi.xml"));
  EXPECT_THAT(files_of_mpcdi(folder_ / "wall.mpcdi.xml"), testing::Contains(folder_ / "maps" / "left.pfm"));
}

TEST_F(MpcdiFile, TellsWhichFilesItNamesUnlessItHoldsThem) {
  write_media(media_xml);
  const std::vector<std::filesystem::path> named = files_of_mpcdi(folder_ / "wall.mpcdi.xml");
  EXPECT_THAT(named, testing::Contains(folder_ / "left.pfm"));
  EXPECT_EQ(named.size(), media_members(media_xml).size() - 1) << "all but the description";
  write("wall.mpcdi", zip_by_hand(media_members(media_xml)));
  EXPECT_THAT(files_of_mpcdi(folder_ / "wall.mpcdi"), testing::IsEmpty());
}

TEST_F(MpcdiFile, PathsThatLeadOutOfTheFolderAreRefused) {
  for (const char* path : {"../left.pfm", "/etc/passwd", "a/../../left.pfm", "C:left.pfm", "..\\left.pfm"}) {
    write_media(replaced(media_xml, "left.pfm", path));
    EXPECT_THAT(problem(), HasSubstr("has the path")) << path;
  }
}

TEST_F(MpcdiFile, LinksThatLeadOutOfTheFolderAreRefused) {
  write_media(media_xml);
  fs::remove(folder_ / "left.pfm");
  fs::create_symlink("/dev/zero", folder_ / "left.pfm");
  EXPECT_THAT(problem(), HasSubstr("is outside the calibration's folder"));
}

TEST_F(MpcdiFile, MissingFileBesideItIsAnErrorWithItsName) {
  write_media(media_xml);
  fs::remove(folder_ / "left.png");
  EXPECT_THAT(problem(), HasSubstr("left.png: does not exist or is not a regular file"));
}

}  // namespace
}  // namespace ergodome
