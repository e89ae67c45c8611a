#include "calibration/formats/warps/bourke_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

//! A mesh written by hand from the page that defines the format. Columns vary fastest, and the
//! bottom row is first. x goes from -2 to 2 on a raster of 2:1; v points upwards.
const std::string mesh_by_hand =
    "2\n3 2\n"
    "-2 -1 0.0 0.25 1\n0 -1 0.5 0.0 0.5\n2 -1 1.0 0.25 1\n"
    "-2 1 0.1 0.75 0.75\n0 1 0.5 1.0 -1\n2 1 0.9 0.75 0\n";

WarpMesh parsed_mesh(const std::string& text) { return parse_bourke_mesh(text, "mesh.data", 2.0); }

std::string mesh_problem(const std::string& text) {
  return test::error_of([&] { parsed_mesh(text); });
}

std::string mesh_with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

void expect_node(const WarpNode& node, float x, float y, float u, float v, float intensity) {
  EXPECT_FLOAT_EQ(node.x, x);
  EXPECT_FLOAT_EQ(node.y, y);
  EXPECT_FLOAT_EQ(node.u, u);
  EXPECT_FLOAT_EQ(node.v, v);
  EXPECT_FLOAT_EQ(node.intensity, intensity);
}

void expect_same_nodes(const WarpMesh& mesh, const WarpMesh& other) {
  ASSERT_EQ(mesh.columns, other.columns);
  ASSERT_EQ(mesh.rows, other.rows);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    EXPECT_NEAR(mesh.nodes[i].x, other.nodes[i].x, 1e-6);
    EXPECT_NEAR(mesh.nodes[i].y, other.nodes[i].y, 1e-6);
    EXPECT_NEAR(mesh.nodes[i].u, other.nodes[i].u, 1e-6);
    EXPECT_NEAR(mesh.nodes[i].v, other.nodes[i].v, 1e-6);
    EXPECT_NEAR(mesh.nodes[i].intensity, other.nodes[i].intensity, 1e-6);
    EXPECT_EQ(mesh.nodes[i].valid, other.nodes[i].valid);
  }
}

TEST(BourkeMesh, LastRowOfTheFileIsTheTopOfTheRaster) {
  const WarpMesh mesh = parsed_mesh(mesh_by_hand);
  ASSERT_EQ(mesh.columns, 3);
  ASSERT_EQ(mesh.rows, 2);
  expect_node(mesh.at(0, 0), 0.0F, 0.0F, 0.1F, 0.25F, 0.75F);
  expect_node(mesh.at(2, 1), 1.0F, 1.0F, 1.0F, 0.75F, 1.0F);
}

TEST(BourkeMesh, FrontOfTheDomeAtTheBottomOfTheMasterIsAtTheBottomOfTheImage) {
  expect_node(parsed_mesh(mesh_by_hand).at(1, 1), 0.5F, 1.0F, 0.5F, 1.0F, 0.5F);
}

TEST(BourkeMesh, RowsFromTopToBottomAreReadToo) {
  const std::string top_first =
      "2\n3 2\n"
      "-2 1 0.1 0.75 0.75\n0 1 0.5 1.0 -1\n2 1 0.9 0.75 0\n"
      "-2 -1 0.0 0.25 1\n0 -1 0.5 0.0 0.5\n2 -1 1.0 0.25 1\n";
  expect_same_nodes(parsed_mesh(top_first), parsed_mesh(mesh_by_hand));
}

TEST(BourkeMesh, NegativeIntensityLeavesANodeOut) {
  const WarpMesh mesh = parsed_mesh(mesh_by_hand);
  EXPECT_FALSE(mesh.at(1, 0).valid);
  EXPECT_TRUE(mesh.at(2, 0).valid);
}

TEST(BourkeMesh, XUpToOneIsReadWithAHalfWidthOfOne) {
  const WarpMesh mesh = parse_bourke_mesh("2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n", "mesh.data", 1.0);
  EXPECT_FLOAT_EQ(mesh.at(0, 0).x, 0.0F);
  EXPECT_FLOAT_EQ(mesh.at(1, 0).x, 1.0F);
}

TEST(BourkeMesh, NodesBeyondTheRasterAreKept) {
  EXPECT_FLOAT_EQ(parsed_mesh(mesh_with(mesh_by_hand, "2 -1 1.0", "4 -1 1.0")).at(2, 1).x, 1.5F);
}

TEST(BourkeMesh, AnyLineEndingBlankLinesAndBlanksAreAccepted) {
  std::string dos = "\xef\xbb\xbf";
  std::string mac;
  for (const char c : mesh_by_hand) {
    dos += c == '\n' ? "\r\n \r\n" : c == ' ' ? " \t " : std::string(1, c);
    mac += c == '\n' ? '\r' : c;
  }
  expect_same_nodes(parsed_mesh(dos), parsed_mesh(mesh_by_hand));
  expect_same_nodes(parsed_mesh(mac), parsed_mesh(mesh_by_hand));
  expect_same_nodes(parsed_mesh(mesh_by_hand.substr(0, mesh_by_hand.size() - 1)), parsed_mesh(mesh_by_hand));
}

TEST(BourkeMesh, PolarMeshKeepsItsRowsAndGoesRound) {
  const WarpMesh mesh = parsed_mesh(mesh_with(mesh_by_hand, "2\n", "1\n"));
  EXPECT_EQ(mesh.topology, MeshTopology::polar);
  EXPECT_FLOAT_EQ(mesh.at(0, 0).y, 1.0F);
}

TEST(BourkeMesh, ReadsBackFromItsOwnText) {
  expect_same_nodes(parsed_mesh(to_bourke_mesh(parsed_mesh(mesh_by_hand), 2.0)), parsed_mesh(mesh_by_hand));
  const WarpMesh polar = parsed_mesh(mesh_with(mesh_by_hand, "2\n", "1\n"));
  expect_same_nodes(parsed_mesh(to_bourke_mesh(polar, 2.0)), polar);
}

TEST(BourkeMesh, IsWrittenFromBottomToTop) {
  EXPECT_THAT(to_bourke_mesh(parsed_mesh(mesh_by_hand), 2.0), testing::StartsWith("2\n3 2\n-2 -1 0 0.25 1\n"));
}

TEST(BourkeMesh, NumbersThatAreNotFiniteAreErrorsWithTheirLine) {
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "0 -1 0.5", "0 nan 0.5")),
              AllOf(HasSubstr("mesh.data:4"), HasSubstr("nan")));
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "0.5\n2", "inf\n2")), HasSubstr("mesh.data:4: has the value inf"));
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "0 -1 0.5", "0 -1e300 0.5")), HasSubstr("mesh.data:4"));
}

TEST(BourkeMesh, WordsThatAreNoNumbersAreErrorsWithTheirLine) {
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "0 -1 0.5", "0 -1 0,5")), HasSubstr("mesh.data:4: has \"0,5\""));
}

TEST(BourkeMesh, OneNodeIsNoMesh) {
  EXPECT_THAT(mesh_problem("2\n1 1\n0 0 0 0 1\n"), AllOf(HasSubstr("mesh.data:2"), HasSubstr("1 x 1")));
}

TEST(BourkeMesh, NegativeAndHugeSizesAreErrors) {
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "3 2", "-3 2")), HasSubstr("-3 x 2"));
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "3 2", "3 2000000000")), HasSubstr("use at most"));
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "3 2", "99999999999999999999 2")), HasSubstr("mesh.data:2"));
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "3 2", "5000 5000")), HasSubstr("but is too short for them"));
}

TEST(BourkeMesh, FewerOrMoreNodesThanAnnouncedAreErrors) {
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "3 2", "3 3")), HasSubstr("ends before node 7 of 9"));
  EXPECT_THAT(mesh_problem(mesh_by_hand + "0 0 0 0 1\n"), HasSubstr("mesh.data:9"));
}

TEST(BourkeMesh, LinesOfAnotherLengthAreErrors) {
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "0.25 1\n", "0.25\n")),
              HasSubstr("mesh.data:3: has fewer than five"));
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "0.25 1\n", "0.25 1 1\n")),
              HasSubstr("mesh.data:3: has more than five"));
}

TEST(BourkeMesh, OfAnotherTypeOrEmptyIsAnError) {
  EXPECT_THAT(mesh_problem(mesh_with(mesh_by_hand, "2\n", "3\n")), HasSubstr("mesh.data:1"));
  EXPECT_THAT(mesh_problem(""), HasSubstr("ends before the mesh's type"));
  EXPECT_THAT(mesh_problem(std::string(100, '\0')), HasSubstr("mesh.data"));
}

TEST(BourkeMesh, WithNothingToDrawIsAnError) {
  EXPECT_THAT(mesh_problem("2\n2 2\n0 0 0 0 -1\n0 0 0 0 -1\n0 0 0 0 -1\n0 0 0 0 -1\n"), HasSubstr("nothing to draw"));
}

}  // namespace
}  // namespace ergodome
