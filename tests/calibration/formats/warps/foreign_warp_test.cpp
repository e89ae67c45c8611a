#include "calibration/formats/warps/foreign_warp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/angles.h"
#include "tests/calibration/handmade_files.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

// Tests of warp files of other programs. Expected values are calculated by hand from the way in
// which the program SGCT reads each format: raster coordinates go from -1 to 1 with y upwards,
// texture coordinates from 0 to 1 with t upwards.
namespace ergodome {
namespace {

using test::error_of;
using test::FolderTest;
using test::little;
using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const std::string& bytes, WarpFormat format) {
  return error_of([&] { parse_foreign_warp(bytes, "a.warp", format); });
}

std::string with_change(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

void expect_node(const WarpNode& node, double x, double y, double u, double v) {
  EXPECT_TRUE(node.valid);
  EXPECT_NEAR(node.x, x, 1e-6);
  EXPECT_NEAR(node.y, y, 1e-6);
  EXPECT_NEAR(node.u, u, 1e-6);
  EXPECT_NEAR(node.v, v, 1e-6);
}

void expect_angles(const WarpView& view, double yaw_deg, double pitch_deg, double roll_deg) {
  EXPECT_NEAR(view.orientation.yaw_deg, yaw_deg, 1e-4);
  EXPECT_NEAR(view.orientation.pitch_deg, pitch_deg, 1e-4);
  EXPECT_NEAR(view.orientation.roll_deg, roll_deg, 1e-4);
}

//! Returns the bytes of a float, least significant first.
std::string float_bytes(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return little(bits, 4);
}

// Format "domeprojection".

const std::string csv =
    "x;y;u;v;column;row\n0.0;0.0;0.1;0.2;0;0\n1.0;0.0;0.9;0.2;1;0\n0.0;1.0;0.1;0.7;0;1\n1.0;1.0;0.9;0.7;1;1\n";

TEST(DomeprojectionWarp, HasYAndVDownwards) {
  const ForeignWarp warp = parse_foreign_warp(csv, "a.csv", WarpFormat::domeprojection);
  ASSERT_EQ(warp.mesh.columns, 2);
  ASSERT_EQ(warp.mesh.rows, 2);
  expect_node(warp.mesh.at(0, 0), 0, 0, 0.1, 0.2);
  expect_node(warp.mesh.at(1, 0), 1, 0, 0.9, 0.2);
  expect_node(warp.mesh.at(0, 1), 0, 1, 0.1, 0.7);
  EXPECT_FALSE(warp.view);
}

TEST(DomeprojectionWarp, IsReadAsOtherProgramsAndCountriesWriteIt) {
  const std::string commas =
      "\xef\xbb\xbf"
      "x;y;u;v;column;row\r\n0,0;0,0;0,1;0,2;0;0\r\n1,0;0,0;0,9;0,2;1;0\r\n0,0;1,0;0,1;0,7;0;1\r\n1,0;1,0;0,9;0,7;1;"
      "1\r\n";
  expect_node(parse_foreign_warp(commas, "a.csv", WarpFormat::domeprojection).mesh.at(1, 1), 1, 1, 0.9, 0.7);
  // This file has no header, its rows are in a different order, and it lacks one node, which is not
  // shown.
  const std::string bare = "1;1;0.9;0.7;1;1\n0;1;0.1;0.7;0;1\n1;0;0.9;0.2;1;0\n";
  const WarpMesh mesh = parse_foreign_warp(bare, "a.csv", WarpFormat::domeprojection).mesh;
  expect_node(mesh.at(0, 1), 0, 1, 0.1, 0.7);
  EXPECT_FALSE(mesh.at(0, 0).valid);
  std::string separated = csv;
  std::ranges::replace(separated, ';', ',');
  expect_node(parse_foreign_warp(separated, "a.csv", WarpFormat::domeprojection).mesh.at(1, 1), 1, 1, 0.9, 0.7);
}

TEST(DomeprojectionWarp, RefusesWhatItCannotRead) {
  const auto problem = [](const std::string& text) { return refusal(text, WarpFormat::domeprojection); };
  EXPECT_THAT(problem(with_change(csv, "0.9;0.2", "nan;0.2")), HasSubstr("a.warp:3: u is nan"));
  EXPECT_THAT(problem(with_change(csv, "0.9;0.2;1", "0.9;0.2")), HasSubstr("a.warp:3: has 5 values instead of 6"));
  EXPECT_THAT(problem(with_change(csv, ";1;1\n", ";99999;1\n")), HasSubstr("the column is \"99999\""));
  EXPECT_THAT(problem(with_change(csv, ";1;1\n", ";900;900\n")), HasSubstr("has 4 nodes for 901 columns and 901 rows"));
  EXPECT_THAT(problem(with_change(csv, ";1;1\n", ";1;0\n")), HasSubstr("has two nodes in column 1, row 0"));
  EXPECT_THAT(problem("x;y;z;u;v;column;row\n"), HasSubstr("is not a flat domeprojection warp"));
  EXPECT_THAT(problem(""), HasSubstr("is a mesh of 0 x 0 nodes"));
}

// Format "Wavefront OBJ".

const std::string obj =
    "# warp\nmtllib a.mtl\nv -1 1 0\nv 1 1 0\nv -1 -1 0\nv 1 -1 0\nvt 0.1 0.8\nvt 0.9 0.8\nvt 0.1 0.3\nvt 0.9 0.3\nvn "
    "0 0 1\n"
    "f 1/1 3/3 4/4\nf 1/1 4/4 2/2\n";

TEST(ObjWarp, HasYAndVUpwards) {
  const WarpMesh mesh = parse_foreign_warp(obj, "a.obj", WarpFormat::obj).mesh;
  ASSERT_EQ(mesh.columns, 2);
  expect_node(mesh.at(0, 0), 0, 0, 0.1, 0.2);
  expect_node(mesh.at(1, 0), 1, 0, 0.9, 0.2);
  expect_node(mesh.at(0, 1), 0, 1, 0.1, 0.7);
}

TEST(ObjWarp, ReadsFacesAsProgramsWriteThem) {
  const std::string head = obj.substr(0, obj.find("f 1/1"));
  for (const char* faces : {"f 1 3 4\nf 1 4 2\n", "f 1/1/1 3/3/1 4/4/1 2/2/1\r\n", "f -4/-4 -2/-2 -1/-1 -3/-3\n"}) {
    const WarpMesh mesh = parse_foreign_warp(head + faces, "a.obj", WarpFormat::obj).mesh;
    ASSERT_EQ(mesh.topology, MeshTopology::rectangular) << faces;
    expect_node(mesh.at(1, 1), 1, 1, 0.9, 0.7);
  }
  // Texture coordinates are in a different order than vertices.
  const std::string own =
      "v -1 1 0\nv 1 1 0\nv -1 -1 0\nv 1 -1 0\nvt 0.9 0.3\nvt 0.1 0.3\nvt 0.9 0.8\nvt 0.1 0.8\nf 1/4 3/2 4/1 2/3\n";
  expect_node(parse_foreign_warp(own, "a.obj", WarpFormat::obj).mesh.at(1, 0), 1, 0, 0.9, 0.2);
}

TEST(ObjWarp, AVertexWithTwoTextureCoordinatesIsTwoNodes) {
  const std::string seam =
      "v -1 1 0\nv 0 1 0\nv 1 1 0\nv -1 -1 0\nv 0 -1 0\nv 1 -1 0\nvt 0 1\nvt 0.5 1\nvt 0.7 1\nvt 1 1\nvt 0 0\nvt 0.5 "
      "0\nvt "
      "0.7 0\nvt 1 0\nf 1/1 4/5 5/6 2/2\nf 2/3 5/7 6/8 3/4\n";
  const WarpMesh mesh = parse_foreign_warp(seam, "a.obj", WarpFormat::obj).mesh;
  ASSERT_EQ(mesh.topology, MeshTopology::separate_cells);
  std::vector<float> at_middle;
  for (const WarpNode& node : mesh.nodes) {
    if (node.valid && node.x == 0.5F && node.y == 0.0F) {
      at_middle.push_back(node.u);
    }
  }
  // The middle vertex has two texture coordinates. In the left face it is the last corner of one
  // triangle, which becomes a cell that repeats this corner. In the right face, two triangles use
  // it.
  EXPECT_THAT(at_middle, testing::UnorderedElementsAre(0.5F, 0.5F, 0.7F, 0.7F));
}

TEST(ObjWarp, RefusesWhatItCannotRead) {
  const auto problem = [](const std::string& text) { return refusal(text, WarpFormat::obj); };
  EXPECT_THAT(problem(with_change(obj, "v 1 -1 0", "v 1 -1 0.5")),
              HasSubstr("a.warp:6: has z = 0.5, but other vertices have z = 0"));
  EXPECT_THAT(problem(with_change(obj, "1/1 3/3 4/4", "1/1 3/3 4/5")),
              HasSubstr("a.warp:12: refers to number 5, but the lines before it define 4"));
  EXPECT_THAT(problem(with_change(obj, "1/1 3/3 4/4", "1//1 3//1 4//1")),
              HasSubstr("every corner of a warp needs texture coordinates"));
  EXPECT_THAT(problem(with_change(obj, "vt 0.9 0.3", "vt 0.9 inf")), HasSubstr("v is inf"));
  EXPECT_THAT(problem(obj.substr(0, obj.find("f 1/1"))), HasSubstr("has no faces"));
}

// Format of SCISS.

//! Returns the bytes of a SCISS file with four nodes and the given view. `first` and `second`
//! describe a grid of 2 x 2 nodes, or the numbers of nodes and indices of its triangles, depending
//! on `version`.
std::string sgc(char version, const std::vector<float>& view, std::uint32_t first, std::uint32_t second,
                const std::vector<std::uint32_t>& indices) {
  std::string bytes = std::string("SGC") + version + little(0, 4);
  for (const float number : view) {
    bytes += float_bytes(number);
  }
  bytes += little(first, 4) + little(second, 4);
  for (const auto& [x, y, u, v] : {std::tuple(0.0F, 0.0F, 0.1F, 0.8F), std::tuple(1.0F, 0.0F, 0.9F, 0.8F),
                                   std::tuple(0.0F, 1.0F, 0.1F, 0.3F), std::tuple(1.0F, 1.0F, 0.9F, 0.3F)}) {
    bytes += float_bytes(x) + float_bytes(y) + little(0, 4) + float_bytes(u) + float_bytes(v) + little(0, 4);
  }
  bytes += little(static_cast<std::uint32_t>(indices.size()), 4);
  for (const std::uint32_t index : indices) {
    bytes += little(index, 4);
  }
  return bytes;
}

//! Returns the view of a SCISS file, which contains a quaternion (x, y, z, w): a rotation up by 40°
//! about x, then to the right by 30° about y.
std::vector<float> up_and_right() {
  const double half_up = 20.0 * one_degree;
  const double half_right = -15.0 * one_degree;
  return {static_cast<float>(std::cos(half_right) * std::sin(half_up)),
          static_cast<float>(std::sin(half_right) * std::cos(half_up)),
          static_cast<float>(-std::sin(half_right) * std::sin(half_up)),
          static_cast<float>(std::cos(half_right) * std::cos(half_up)),
          0.0F,
          0.0F,
          0.0F,
          20.0F,
          -15.0F,
          -25.0F,
          30.0F};
}

TEST(ScissWarp, TellsItsViewAndHasVUpwards) {
  const ForeignWarp warp =
      parse_foreign_warp(sgc('\1', up_and_right(), 2, 2, {0, 2, 1, 3}), "a.sgc", WarpFormat::sciss);
  expect_node(warp.mesh.at(0, 0), 0, 0, 0.1, 0.2);
  expect_node(warp.mesh.at(1, 1), 1, 1, 0.9, 0.7);
  ASSERT_TRUE(warp.view);
  expect_angles(*warp.view, 30, 40, 0);
  EXPECT_EQ(warp.view->frustum.up_deg, 20.0);
  EXPECT_EQ(warp.view->frustum.down_deg, -15.0);
  EXPECT_EQ(warp.view->frustum.left_deg, -25.0);
  EXPECT_EQ(warp.view->frustum.right_deg, 30.0);
}

TEST(ScissWarp, ReadsBothVersionsHoweverTheyAreWritten) {
  for (const std::string& bytes :
       {sgc('1', up_and_right(), 2, 2, {}), sgc('\2', up_and_right(), 4, 4, {0, 2, 1, 2, 3, 1}),
        sgc('2', up_and_right(), 5, 4, {0, 2, 1, 3})}) {
    const WarpMesh mesh = parse_foreign_warp(bytes, "a.sgc", WarpFormat::sciss).mesh;
    ASSERT_EQ(mesh.columns, 2);
    expect_node(mesh.at(1, 0), 1, 0, 0.9, 0.2);
  }
  std::vector<float> moved = up_and_right();
  moved[5] = 1.5F;
  const ForeignWarp warp = parse_foreign_warp(sgc('1', moved, 2, 2, {}), "a.sgc", WarpFormat::sciss);
  ASSERT_EQ(warp.notes.size(), 1U);
  EXPECT_THAT(warp.notes[0], HasSubstr("its position (0, 1.5, 0) is ignored"));
}

TEST(ScissWarp, RefusesWhatItCannotRead) {
  const auto problem = [](const std::string& bytes) { return refusal(bytes, WarpFormat::sciss); };
  const std::string good = sgc('1', up_and_right(), 2, 2, {0, 2, 1, 3});
  for (std::size_t size = 4; size < good.size(); ++size) {
    EXPECT_NE(problem(good.substr(0, size)), "") << size;
  }
  std::string cube = good;
  cube[4] = '\1';
  EXPECT_THAT(problem(cube), AllOf(HasSubstr("uses a cube map"), HasSubstr("export it with a planar mapping")));
  EXPECT_THAT(problem(sgc('3', up_and_right(), 2, 2, {})), HasSubstr("has the unsupported version"));
  EXPECT_THAT(problem(sgc('2', up_and_right(), 6, 4, {0, 1, 2})), HasSubstr("has indices of the unknown type 6"));
  EXPECT_THAT(problem(sgc('2', up_and_right(), 4, 4, {0, 1, 9})), HasSubstr("has a triangle with node 9"));
  EXPECT_THAT(problem(sgc('1', up_and_right(), 0x10000, 0x10000, {})), HasSubstr("declares 4294967296 nodes"));
  EXPECT_THAT(problem(good + "x"), HasSubstr("has 1 extra bytes after its last index"));
  std::vector<float> view = up_and_right();
  view[3] = 0.0F;
  EXPECT_THAT(problem(sgc('1', view, 2, 2, {})), HasSubstr("has a direction quaternion of length"));
  view = up_and_right();
  view[9] = 25.0F;
  view[10] = 25.0F;
  EXPECT_THAT(problem(sgc('1', view, 2, 2, {})),
              HasSubstr("has an impossible field of view: 25° (left) to 25° (right)"));
  view[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(problem(sgc('1', view, 2, 2, {})), HasSubstr("has the value nan in the quaternion"));
}

// Format of EasyBlend.

const std::string openmesh =
    "OPENMESH Version 1.1\nVERTICES 4\nFACES 2\nMAPPING NORMALIZED\nSAMPLING LINEAR\nPROJECTION "
    "PERSPECTIVE\nORTHO_LEFT 0\n"
    "ORTHO_RIGHT 1\nORTHO_TOP 1\nORTHO_BOTTOM 0\nPERSPECTIVE_XOFFSET 0\nPERSPECTIVE_ROLL 0\nPERSPECTIVE_PITCH 40\n"
    "PERSPECTIVE_YAW -30\nPERSPECTIVE_LEFT -25\nPERSPECTIVE_RIGHT 30\nPERSPECTIVE_TOP 20\nPERSPECTIVE_BOTTOM -15\n"
    "NATIVEXRES 1920\nNATIVEYRES 1200\nSUBVERSION 5\nGAMMA 2.2\nDO_NO_WARP 0\nLABEL north dome\n"
    "0 1200 255 0.2 0.9\n1920 1200 255 0.2 0.1\n0 0 128 0.7 0.9\n1920 0 0 0.7 0.1\n[ 0 2 1 ]\n[ 1 2 3 ]\n";

TEST(EasyblendWarp, HasPixelsUpwardsAndTurnedTextures) {
  const ForeignWarp warp = parse_foreign_warp(openmesh, "a.ol", WarpFormat::easyblend);
  ASSERT_EQ(warp.mesh.columns, 2);
  expect_node(warp.mesh.at(0, 0), 0, 0, 0.1, 0.2);
  expect_node(warp.mesh.at(1, 0), 1, 0, 0.9, 0.2);
  expect_node(warp.mesh.at(0, 1), 0, 1, 0.1, 0.7);
  EXPECT_EQ(warp.mesh.at(0, 0).intensity, 1.0F);
  EXPECT_NEAR(warp.mesh.at(0, 1).intensity, 0.219520, 1e-5);  // (128 / 255) ^ 2.2
  EXPECT_EQ(warp.mesh.at(1, 1).intensity, 0.0F);
  ASSERT_TRUE(warp.view);
  expect_angles(*warp.view, 30, 40, 0);
  EXPECT_EQ(warp.view->frustum.left_deg, -25.0);
  EXPECT_EQ(warp.view->frustum.up_deg, 20.0);
  EXPECT_TRUE(warp.notes.empty());
}

TEST(EasyblendWarp, RollsAnticlockwiseAboutTheFront) {
  const std::string rolled =
      with_change(with_change(with_change(openmesh, "ROLL 0", "ROLL 10"), "PITCH 40", "PITCH 0"), "YAW -30", "YAW 0");
  const ForeignWarp warp = parse_foreign_warp(rolled, "a.ol", WarpFormat::easyblend);
  expect_angles(*warp.view, 0, 0, -10);
}

TEST(EasyblendWarp, IsCutToItsPartOfTheRaster) {
  const ForeignWarp warp =
      parse_foreign_warp(with_change(openmesh, "ORTHO_RIGHT 1", "ORTHO_RIGHT 2"), "a.ol", WarpFormat::easyblend);
  expect_node(warp.mesh.at(1, 0), 0.5, 0, 0.9, 0.2);
}

TEST(EasyblendWarp, SaysWhatItDoesNotUse) {
  const ForeignWarp warp = parse_foreign_warp(with_change(openmesh, "LABEL", "APPLY_MASK 1\nSOMETHING_NEW 3\nLABEL"),
                                              "a.ol", WarpFormat::easyblend);
  ASSERT_EQ(warp.notes.size(), 2U);
  EXPECT_THAT(warp.notes[0], HasSubstr("SOMETHING_NEW"));
  EXPECT_THAT(warp.notes[1], HasSubstr("APPLY_MASK"));
}

TEST(EasyblendWarp, RefusesWhatItCannotRead) {
  const auto problem = [](const std::string& from, const std::string& to) {
    return refusal(with_change(openmesh, from, to), WarpFormat::easyblend);
  };
  EXPECT_THAT(problem("XOFFSET 0", "XOFFSET 0.5"), HasSubstr("uses PERSPECTIVE_XOFFSET 0.5, which is not supported"));
  EXPECT_THAT(problem("DO_NO_WARP 0", "DO_NO_WARP 1"), HasSubstr("uses DO_NO_WARP"));
  EXPECT_THAT(problem("LABEL", "FRUSTUM_EULER_ANGLES 1\nLABEL"), HasSubstr("uses FRUSTUM_EULER_ANGLES"));
  EXPECT_THAT(problem("PROJECTION PERSPECTIVE", "PROJECTION CYLINDER"), HasSubstr("a.warp:6: has PROJECTION CYLINDER"));
  EXPECT_THAT(problem("MAPPING NORMALIZED", "MAPPING PIXELS"), HasSubstr("only NORMALIZED is supported"));
  EXPECT_THAT(problem("VERTICES 4", "VERTICES 5"), HasSubstr("declares 5 vertices and 2 faces, but has 4 and 2"));
  EXPECT_THAT(problem("[ 1 2 3 ]", "[ 1 2 4 ]"), HasSubstr("has a triangle with node 4"));
  EXPECT_THAT(problem("[ 1 2 3 ]", "[ 1 2 3 0 ]"), HasSubstr("a face without exactly three nodes"));
  EXPECT_THAT(problem("0 0 128", "0 0 300"), HasSubstr("has an intensity of 300"));
  EXPECT_THAT(problem("0 0 128", "0 nan 128"), HasSubstr("y is nan"));
  EXPECT_THAT(problem("NATIVEXRES 1920\n", ""), HasSubstr("does not give the size of its raster"));
}

// Format of SimCAD.

std::string simcad(const std::string& x, const std::string& y, const std::string& range = " range=\"1920\"") {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<GeometryFile>\r\n <GeometryDefinition>\r\n  "
         "<TDRmode>0</TDRmode>\r\n"
         "  <X-FlatParameters" +
         range + ">" + x +
         "</X-FlatParameters>\r\n"
         "  <Y-FlatParameters range=\"1200\">" +
         y + "</Y-FlatParameters>\r\n </GeometryDefinition>\r\n</GeometryFile>\r\n";
}

TEST(SimcadWarp, MovesNodesToTheRightAndDown) {
  const std::string file = simcad("0 0 0 0 192 0 0 0 -19.2", "0 0 0 0 120 0 0\r\n0 0");
  const ForeignWarp warp = parse_foreign_warp(file, "a.simcad", WarpFormat::simcad);
  ASSERT_EQ(warp.mesh.columns, 3);
  expect_node(warp.mesh.at(0, 0), 0, 0, 0, 0);
  expect_node(warp.mesh.at(1, 1), 0.6, 0.6, 0.5, 0.5);
  expect_node(warp.mesh.at(2, 2), 0.99, 1, 1, 1);
  const ForeignWarp commas =
      parse_foreign_warp(simcad("0 0 0,5 0", "0 0 0 0", " range=\"1\""), "a.simcad", WarpFormat::simcad);
  expect_node(commas.mesh.at(0, 1), 0.5, 1, 0, 1);
}

TEST(SimcadWarp, RefusesWhatItCannotRead) {
  const auto problem = [](const std::string& text) { return refusal(text, WarpFormat::simcad); };
  EXPECT_THAT(problem(simcad("0 0 0 0", "0 0 0")), HasSubstr("has 4 offsets, and Y-FlatParameters has 3"));
  EXPECT_THAT(problem(simcad("0 0 0 0 0", "0 0 0 0 0")), HasSubstr("for a square grid"));
  EXPECT_THAT(problem(simcad("0 0 0 nan", "0 0 0 0")),
              HasSubstr("a.warp:5: <X-FlatParameters> has the invalid offset \"nan\""));
  EXPECT_THAT(problem(simcad("0 0 0 0", "0 0 0 0", "")), HasSubstr("has no range"));
  EXPECT_THAT(problem(simcad("0 0 0 0", "0 0 0 0", " range=\"0\"")), HasSubstr("has a range of 0"));
  EXPECT_THAT(problem(simcad("", "")), HasSubstr("is a mesh of 0 x 0 nodes"));
  EXPECT_THAT(problem(simcad("0 0 0 0", "0 0 0 0").substr(0, 150)), HasSubstr("is not well-formed XML"));
}

// Format of Sky-Skan.

const std::string skyskan =
    "Dome Azimuth=30\r\nDome Elevation=40\r\nHorizontal FOV=60\r\nVertical FOV=40\r\nHorizontal Tweak=1.0\r\n2 2\r\n"
    "0 0 0.1 0.2\r\n1 0 0.9 0.2\r\n0 1 0.1 0.7\r\n1 1 0.9 0.7\r\n";

TEST(SkyskanWarp, TellsItsViewAndHasYAndVDownwards) {
  const ForeignWarp warp = parse_foreign_warp(skyskan, "a.txt", WarpFormat::skyskan);
  expect_node(warp.mesh.at(0, 0), 0, 0, 0.1, 0.2);
  expect_node(warp.mesh.at(0, 1), 0, 1, 0.1, 0.7);
  ASSERT_TRUE(warp.view);
  expect_angles(*warp.view, 30, 40, 0);
  EXPECT_EQ(warp.view->frustum.left_deg, -30.0);
  EXPECT_EQ(warp.view->frustum.up_deg, 20.0);
}

TEST(SkyskanWarp, AppliesTweaksAndTheHeightOfItsRaster) {
  const std::string wide =
      with_change(with_change(skyskan, "FOV=60", "FOV=90"), "Vertical FOV=40\r\nHorizontal Tweak=1.0",
                  "Horizontal Tweak=0.5\r\nVertical Tweak=2\r\nU Tweak=0.5\r\nV Tweak=-5");
  const ForeignWarp warp = parse_foreign_warp(wide, "a.txt", WarpFormat::skyskan);
  EXPECT_NEAR(warp.view->frustum.right_deg, 22.5, 1e-9);
  // The vertical half angle is atan(1200 / 2048) = 30.3681°, from the aspect ratio of the raster.
  // The vertical tweak doubles it.
  EXPECT_NEAR(warp.view->frustum.up_deg, 2.0 * 30.3681, 1e-3);
  expect_node(warp.mesh.at(1, 1), 1, 1, 0.45, 0.7);
  const ForeignWarp holed =
      parse_foreign_warp(with_change(skyskan, "1 1 0.9 0.7", "-1 -1 0 0"), "a.txt", WarpFormat::skyskan);
  EXPECT_FALSE(holed.mesh.at(1, 1).valid);
}

TEST(SkyskanWarp, RefusesWhatItCannotRead) {
  const auto problem = [](const std::string& from, const std::string& to) {
    return refusal(with_change(skyskan, from, to), WarpFormat::skyskan);
  };
  EXPECT_THAT(problem("Dome Azimuth=30\r\n", ""), HasSubstr("has no dome azimuth"));
  EXPECT_THAT(problem("FOV=60", "FOV=180"), HasSubstr("has a horizontal FOV of 180°"));
  EXPECT_THAT(problem("1 1 0.9 0.7\r\n", ""), HasSubstr("the file ends after 3 of 4 nodes"));
  EXPECT_THAT(problem("1 1 0.9 0.7", "1 1 0.9 0.7\r\n0 0 0 0"),
              HasSubstr("a.warp:11: extra line after the last of 4 nodes"));
  EXPECT_THAT(problem("2 2\r\n", "9000 3000\r\n"), HasSubstr("declares 9000 x 3000 nodes, but is too short"));
  EXPECT_THAT(problem("0.9 0.2", "1e9 0.2"), HasSubstr("a.warp:8: u is 1e9"));
  EXPECT_THAT(problem("Horizontal Tweak", "Sideways Tweak"), HasSubstr("has the unknown key \"sideways tweak\""));
}

// Detection of formats, and setups that refer to such files.

TEST(WarpFormats, AreToldByContent) {
  EXPECT_EQ(format_of_content(csv), WarpFormat::domeprojection);
  EXPECT_EQ(format_of_content("0,1;0,2;0,3;0,4;0;0\r\n"), WarpFormat::domeprojection);
  EXPECT_EQ(format_of_content(obj), WarpFormat::obj);
  EXPECT_EQ(format_of_content(openmesh), WarpFormat::easyblend);
  EXPECT_EQ(format_of_content("\xef\xbb\xbf" + skyskan), WarpFormat::skyskan);
  EXPECT_EQ(format_of_content(simcad("0", "0")), WarpFormat::simcad);
  EXPECT_EQ(format_of_content(sgc('1', up_and_right(), 2, 2, {})), WarpFormat::sciss);
  EXPECT_EQ(format_of_content("<?xml version=\"1.0\"?><MPCDI/>"), WarpFormat::mpcdi);
  EXPECT_EQ(format_of_content("PF\n2 2\n-1.0\n"), WarpFormat::pfm);
  for (const char* none : {"", "2\n2 2\n-1 -1 0 0 1\n", "<svg/>", "id;name;ra\n", "v = 3\n", "\n\n"}) {
    EXPECT_EQ(format_of_content(none), std::nullopt) << none;
  }
  EXPECT_THAT(refusal(csv, WarpFormat::skyskan), AllOf(HasSubstr("is a domeprojection warp, not a Sky-Skan warp"),
                                                       HasSubstr("format = \"domeprojection\"")));
  EXPECT_THAT(refusal(std::string("\xff\xfe"
                                  "x\0;\0",
                                  6),
                      WarpFormat::domeprojection),
              HasSubstr("is text in UTF-16"));
}

TEST(WarpFormats, FilesOfOtherKindsAreToldPlainly) {
  EXPECT_THAT(refusal("Notes on projectors\n", WarpFormat::skyskan),
              HasSubstr("is not a Sky-Skan warp, because it begins with \"Notes on projectors\""));
  EXPECT_THAT(refusal("Notes on projectors\n", WarpFormat::obj), HasSubstr("is not a Wavefront OBJ mesh"));
  EXPECT_THAT(refusal("id;name;ra\n", WarpFormat::domeprojection), HasSubstr("its columns are \"id;name;ra\""));
  EXPECT_THAT(refusal("Notes\n", WarpFormat::sciss), HasSubstr("is not a SCISS warp"));
  EXPECT_THAT(refusal("1 2 3 4 5\n", WarpFormat::easyblend), HasSubstr("is not an EasyBlend mesh"));
  EXPECT_THAT(refusal("<svg/>", WarpFormat::simcad), HasSubstr("is not a SimCAD warp"));
  EXPECT_THAT(refusal(std::string("\x89PNG\r\n\0\0", 8), WarpFormat::obj),
              HasSubstr("is a binary file, not a Wavefront"));
}

class WarpsOfOthers : public FolderTest {
 protected:
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  DomeSetup setup(const std::string& lines, const std::string& dome = "") const {
    const std::string head =
        "[dome]\nradius_m = 5\n" + dome + "[[projector]]\nname = \"P\"\nresolution_px = [64, 40]\n";
    return parse_dome_setup(head + lines, (folder_ / "dome.toml").string(), NamedFiles::must_exist);
  }
};

TEST_F(WarpsOfOthers, AViewOfTheFileBecomesPlacesOfTheDomemaster) {
  const std::string whole =
      with_change(with_change(with_change(with_change(skyskan, "0 0 0.1 0.2", "0 0 0 0"), "1 0 0.9 0.2", "1 0 1 0"),
                              "0 1 0.1 0.7", "0 1 0 1"),
                  "1 1 0.9 0.7", "1 1 1 1");
  write("a.txt", whole);
  const auto pictures = projector_pictures(setup("warp = \"a.txt\"\n"));
  const WarpMesh warp = resampled_warp(pictures[0].warp, 3, 3);
  // The middle of the raster shows azimuth 30° (to the right of the front, which is at the bottom
  // of the master), 50° from the zenith. Its radius in the master is 0.5 · 50 / 90.
  EXPECT_NEAR(warp.at(1, 1).u, 0.5 + 0.277778 * 0.5, 1e-4);
  EXPECT_NEAR(warp.at(1, 1).v, 0.5 + 0.277778 * 0.866025, 1e-4);
  // A sixth of the raster below its top, the direction is higher by atan(2 / 3 · tan 20°) =
  // 13.6397°, so the radius is 0.5 · 36.3603 / 90.
  EXPECT_NEAR(warp.at(1, 0).u, 0.5 + 0.202002 * 0.5, 1e-4);
  EXPECT_NEAR(warp.at(1, 0).v, 0.5 + 0.202002 * 0.866025, 1e-4);
  // Nodes on the right side of the raster are farther to the right in the master, too.
  EXPECT_GT(warp.at(2, 1).u, warp.at(1, 1).u + 0.05F);
  ASSERT_EQ(pictures[0].notes.size(), 1U);
  EXPECT_THAT(pictures[0].notes[0], HasSubstr("yaw 30.00°, pitch 40.00°"));
  // On a dome whose front is tilted down by 10°, the same direction is closer to the zenith of the
  // master.
  const auto leaning = projector_pictures(setup("warp = \"a.txt\"\n", "tilt_deg = 10\n"));
  const WarpNode leaned = resampled_warp(leaning[0].warp, 3, 3).at(1, 1);
  EXPECT_LT(std::hypot(leaned.u - 0.5F, leaned.v - 0.5F), 0.277778 - 0.03);
}

TEST_F(WarpsOfOthers, AWarpOfThePictureOfALensTakesTheSetupsFrustum) {
  write("a.simcad", simcad("0 0 0 0", "0 0 0 0"));
  const std::string lens =
      "yaw_deg = 30\npitch_deg = 40\nfrustum = { left_deg = -30, right_deg = 30, up_deg = 20, down_deg = -20 }\n";
  const auto pictures = projector_pictures(setup(lens + "warp = { file = \"a.simcad\", source = \"lens\" }\n"));
  const WarpNode high = resampled_warp(pictures[0].warp, 3, 3).at(1, 0);
  EXPECT_NEAR(high.u, 0.5 + 0.202002 * 0.5, 1e-4);
  EXPECT_NEAR(high.v, 0.5 + 0.202002 * 0.866025, 1e-4);
  // If the setup does not give a frustum, the warp refers to the whole master.
  const auto of_master = projector_pictures(setup("warp = \"a.simcad\"\n"));
  EXPECT_EQ(of_master[0].warp.at(1, 0).u, 1.0F);
  EXPECT_THAT(error_of([&] { setup("warp = { file = \"a.simcad\", source = \"lens\" }\n"); }),
              HasSubstr("the projector has no frustum"));
  EXPECT_THAT(error_of([&] { setup("warp = { file = \"a.simcad\", rows = \"top_down\" }\n"); }),
              HasSubstr("it is only for pfm and mpcdi"));
}

TEST_F(WarpsOfOthers, AreReadUnderAnyName) {
  write("warp.xml", simcad("0 0 0 0", "0 0 0 0"));
  write("warp.dat", csv);
  write("warp.obj", skyskan);
  write("photo.dat", "\x89PNG");
  EXPECT_EQ(setup("warp = \"warp.xml\"\n").projectors[0].warp->format, WarpFormat::simcad);
  EXPECT_EQ(setup("warp = \"warp.dat\"\n").projectors[0].warp->format, WarpFormat::domeprojection);
  const DomeSetup reported = setup("warp = \"warp.obj\"\n");
  EXPECT_EQ(reported.projectors[0].warp->format, WarpFormat::skyskan);
  EXPECT_THAT(error_of([&] { setup("warp = \"photo.dat\"\n"); }), HasSubstr("of an unknown format"));
  EXPECT_THAT(error_of([&] { projector_pictures(setup("warp = { file = \"warp.xml\", format = \"obj\" }\n")); }),
              HasSubstr("is a SimCAD warp, not a Wavefront OBJ mesh (warp of "));
  // The detected format is kept when the setup is written as text and read back.
  const DomeSetup again = parse_dome_setup(to_toml(reported), "dome.toml", NamedFiles::unchecked);
  EXPECT_EQ(again.projectors[0].warp->format, WarpFormat::skyskan);
}

}  // namespace
}  // namespace ergodome
