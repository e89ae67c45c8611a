#include "calibration/dome/dome_setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

const std::string whole_setup = R"([dome]
radius_m = 7.4
tilt_deg = 15
[viewer]
position_m = [0.5, -1, 2]
[[projector]]
name = "north"
position_m = [0, 0.2, -7]
yaw_deg = 180
pitch_deg = 40
roll_deg = -2.5
frustum = { left_deg = -25, right_deg = 30, up_deg = 20, down_deg = -15.5 }
resolution_px = [1920, 1200]
monitor = 1
warp = "north.data"
blend_mask = "north.png"
blend_mask_gamma = 2.2
black_level_mask = "black.png"
black_level_lift = [0.01, 0.02, 0.015]
gamma = 2.4
gain = [1.0, 0.95, 0.9]
[[projector]]
name = "mirror"
position_m = [0, 0, 0.5]
fisheye = { fov_deg = 160, polynomial = [0.6, -0.01], offset = [0.1, -0.2] }
mirror = { position_m = [0, 0, 1.5], radius_m = 0.3 }
resolution_px = [1400, 1050]
window_px = [1920, -10]
warp = { file = "mirror.bin", format = "pfm", rows = "top_down", texture = "upwards" }
black_level_lift = 0.03
)";

const std::string minimum =
    "[dome]\nradius_m = 5\n[[projector]]\nname = \"a\"\nresolution_px = [640, 480]\nfisheye = { fov_deg = 180 }\n";

DomeSetup parsed_setup(const std::string& text) { return parse_dome_setup(text, "dome.toml", NamedFiles::unchecked); }

std::string setup_problem(const std::string& text) {
  return error_of([&] { parsed_setup(text); });
}

std::string problem_with(const std::string& from, const std::string& to) {
  std::string text = whole_setup;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return setup_problem(text.replace(text.find(from), from.size(), to));
}

void expect_position(const Vector3<double>& v, double x, double y, double z) {
  EXPECT_EQ(v.x, x);
  EXPECT_EQ(v.y, y);
  EXPECT_EQ(v.z, z);
}

void expect_north(const ProjectorSetup& north) {
  EXPECT_EQ(north.name, "north");
  expect_position(north.position_m, 0, 0.2, -7);
  EXPECT_EQ(north.orientation.yaw_deg, 180.0);
  EXPECT_EQ(north.orientation.roll_deg, -2.5);
  ASSERT_TRUE(std::holds_alternative<Frustum>(north.lens));
  EXPECT_EQ(std::get<Frustum>(north.lens).down_deg, -15.5);
  EXPECT_EQ(north.width_px, 1920);
  EXPECT_EQ(north.output.monitor, 1);
  ASSERT_TRUE(north.warp);
  EXPECT_EQ(north.warp->file, "north.data");
  EXPECT_EQ(north.warp->format, WarpFormat::bourke);
  EXPECT_FALSE(north.warp->x_to_one);
  EXPECT_EQ(north.blend_mask, "north.png");
  EXPECT_EQ(north.blend_mask_gamma, 2.2);
  EXPECT_EQ(north.black_level_mask, "black.png");
  expect_position(north.black_level_lift, 0.01, 0.02, 0.015);
  EXPECT_EQ(north.gamma, 2.4);
  expect_position(north.gain, 1.0, 0.95, 0.9);
}

void expect_mirror(const ProjectorSetup& mirror) {
  ASSERT_TRUE(std::holds_alternative<ProjectorFisheye>(mirror.lens));
  const ProjectorFisheye& lens = std::get<ProjectorFisheye>(mirror.lens);
  EXPECT_EQ(lens.field_of_view_deg, 160.0);
  EXPECT_THAT(lens.polynomial, testing::ElementsAre(0.6, -0.01));
  EXPECT_EQ(lens.offset_y, -0.2);
  ASSERT_TRUE(mirror.mirror);
  expect_position(mirror.mirror->position_m, 0, 0, 1.5);
  EXPECT_FALSE(mirror.output.monitor);
  EXPECT_EQ(mirror.output.window_y_px, -10);
  ASSERT_TRUE(mirror.warp);
  EXPECT_EQ(mirror.warp->format, WarpFormat::pfm);
  EXPECT_EQ(mirror.warp->rows, RowOrder::top_down);
  EXPECT_EQ(mirror.warp->texture, TextureDirection::upwards);
  expect_position(mirror.black_level_lift, 0.03, 0.03, 0.03);
}

void expect_whole(const DomeSetup& setup) {
  EXPECT_EQ(setup.radius_m, 7.4);
  EXPECT_EQ(setup.tilt_deg, 15.0);
  expect_position(setup.viewer_m, 0.5, -1, 2);
  ASSERT_EQ(setup.projectors.size(), 2U);
  expect_north(setup.projectors[0]);
  expect_mirror(setup.projectors[1]);
}

TEST(DomeSetup, ReadsAsItIsWritten) { expect_whole(parsed_setup(whole_setup)); }

TEST(DomeSetup, ReadsBackFromItsOwnText) { expect_whole(parsed_setup(to_toml(parsed_setup(whole_setup)))); }

TEST(DomeSetup, LeavesOutWhatHasACustomaryValue) {
  const DomeSetup setup = parsed_setup(minimum);
  EXPECT_EQ(setup.tilt_deg, 0.0);
  EXPECT_EQ(setup.projectors[0].gamma, 2.2);
  expect_position(setup.projectors[0].gain, 1, 1, 1);
  expect_position(setup.projectors[0].black_level_lift, 0, 0, 0);
  EXPECT_FALSE(setup.projectors[0].warp);
  EXPECT_EQ(std::get<ProjectorFisheye>(setup.projectors[0].lens).circle, 1.0);
}

TEST(DomeSetup, FormatOfAWarpIsToldByItsEnding) {
  const auto format = [](const std::string& name) {
    return parsed_setup(minimum + "warp = \"" + name + "\"\n").projectors[0].warp->format;
  };
  EXPECT_EQ(format("a.data"), WarpFormat::bourke);
  EXPECT_EQ(format("a.PFM"), WarpFormat::pfm);
  EXPECT_EQ(format("a.mpcdi"), WarpFormat::mpcdi);
  EXPECT_EQ(format("a.mpcdi.xml"), WarpFormat::mpcdi);
  EXPECT_THAT(setup_problem(minimum + "warp = \"a.bin\"\n"),
              AllOf(HasSubstr("dome.toml:7"), HasSubstr("of an unknown format")));
}

TEST(DomeSetup, KeysOfOtherFormatsAreErrors) {
  EXPECT_THAT(setup_problem(minimum + "warp = { file = \"a.data\", region = \"b\" }\n"),
              HasSubstr("warp.region has no meaning"));
  EXPECT_THAT(setup_problem(minimum + "warp = { file = \"a.mpcdi\", texture = \"upwards\" }\n"),
              HasSubstr("warp.texture"));
  EXPECT_THAT(setup_problem(minimum + "warp = { file = \"a.pfm\", x_range = \"one\" }\n"), HasSubstr("warp.x_range"));
  EXPECT_THAT(setup_problem(minimum + "warp = { file = \"a.data\", rows = \"top_down\" }\n"), HasSubstr("warp.rows"));
}

TEST(DomeSetup, RotationIsReadAndWritten) {
  std::string text = minimum;
  text.replace(text.find("radius_m = 5\n"), 13, "radius_m = 5\nrotation_deg = -7.5\n");
  EXPECT_EQ(parsed_setup(text).rotation_deg, -7.5);
  EXPECT_EQ(parsed_setup(to_toml(parsed_setup(text))).rotation_deg, -7.5);
}

TEST(DomeSetup, UnknownKeysAreErrorsThatNameTheNearest) {
  EXPECT_THAT(problem_with("pitch_deg", "picth_deg"),
              AllOf(HasSubstr("dome.toml:10"), HasSubstr("did you mean \"pitch_deg\"?")));
  EXPECT_THAT(problem_with("tilt_deg", "tilt"), HasSubstr("dome.tilt"));
  EXPECT_THAT(problem_with("[viewer]", "[veiwer]"), HasSubstr("did you mean \"viewer\"?"));
}

TEST(DomeSetup, ValuesOutOfRangeAreErrorsWithTheirLine) {
  EXPECT_THAT(problem_with("radius_m = 7.4", "radius_m = -7.4"), HasSubstr("dome.toml:2: dome.radius_m is -7.4"));
  EXPECT_THAT(problem_with("radius_m = 7.4", "radius_m = nan"), HasSubstr("dome.toml:2"));
  EXPECT_THAT(problem_with("[1920, 1200]", "[-1920, 1200]"), HasSubstr("dome.toml:13"));
  EXPECT_THAT(problem_with("[1920, 1200]", "[1920.5, 1200]"), HasSubstr("fraction of a pixel"));
  EXPECT_THAT(problem_with("[1920, 1200]", "[1920]"), HasSubstr("write 2 numbers"));
  EXPECT_THAT(problem_with("gamma = 2.4", "gamma = 0"), HasSubstr("gamma is 0"));
  EXPECT_THAT(problem_with("gain = [1.0, 0.95, 0.9]", "gain = [1.0, inf, 0.9]"), HasSubstr("gain"));
  EXPECT_THAT(problem_with("gain = [1.0, 0.95, 0.9]", "gain = \"red\""), HasSubstr("gain is not a number"));
  EXPECT_THAT(problem_with("[0, 0.2, -7]", "[0, \"up\", -7]"), HasSubstr("dome.toml:8"));
  EXPECT_THAT(problem_with("monitor = 1", "monitor = -1"), HasSubstr("dome.toml:14"));
}

TEST(DomeSetup, ImpossibleLensesAreErrors) {
  EXPECT_THAT(problem_with("left_deg = -25", "left_deg = 31"), HasSubstr("not below right_deg"));
  EXPECT_THAT(problem_with("up_deg = 20", "up_deg = 90"), HasSubstr("up_deg is 90"));
  EXPECT_THAT(problem_with("left_deg = -25, ", ""), HasSubstr("left_deg is missing"));
  EXPECT_THAT(problem_with("[0.6, -0.01]", "[0.6, -0.2]"), HasSubstr("polynomial does not increase"));
  EXPECT_THAT(problem_with("offset = [0.1, -0.2]", "circle = 1.2"), HasSubstr("cannot be combined with polynomial"));
  EXPECT_THAT(
      problem_with("mirror = {", "frustum = { left_deg = -1, right_deg = 1, up_deg = 1, down_deg = -1 }\nmirror = {"),
      HasSubstr("cannot be combined with frustum"));
}

TEST(DomeSetup, ImpossiblePlacesAreErrors) {
  EXPECT_THAT(problem_with("[0.5, -1, 2]", "[0.5, -1, 20]"), HasSubstr("viewer.position_m lies outside the dome"));
  EXPECT_THAT(problem_with("[0, 0.2, -7]", "[0, 20, -7000]"), HasSubstr("ten dome radii"));
  EXPECT_THAT(problem_with("radius_m = 0.3", "radius_m = 1.2"), HasSubstr("inside the mirror"));
  EXPECT_THAT(problem_with("[0, 0, 1.5]", "[0, 0, 9]"), HasSubstr("mirror lies outside the dome"));
  EXPECT_THAT(problem_with(", radius_m = 0.3", ""), HasSubstr("is missing"));
}

TEST(DomeSetup, ProjectorsThatShareANameOrAnOutputAreErrors) {
  EXPECT_THAT(problem_with("\"mirror\"", "\"north\""), HasSubstr("name \"north\" is used twice"));
  EXPECT_THAT(problem_with("window_px = [1920, -10]", "monitor = 1"), HasSubstr("overlaps the output of \"north\""));
  EXPECT_THAT(problem_with("monitor = 1", "window_px = [1000, 0]"), HasSubstr("overlaps the output of \"north\""));
  EXPECT_EQ(problem_with("monitor = 1", "window_px = [0, 0]"), "");
  EXPECT_THAT(problem_with("monitor = 1", "monitor = 1\nwindow_px = [0, 0]"), HasSubstr("one output"));
}

TEST(DomeSetup, MissingPartsAreErrors) {
  EXPECT_THAT(setup_problem(""), HasSubstr("dome is missing"));
  EXPECT_THAT(setup_problem("[dome]\n[[projector]]\n"), HasSubstr("dome.radius_m is missing"));
  EXPECT_THAT(setup_problem("[dome]\nradius_m = 5\n"), HasSubstr("projector is missing"));
  EXPECT_THAT(problem_with("name = \"north\"", ""), HasSubstr("name is missing"));
  EXPECT_THAT(problem_with("resolution_px = [1920, 1200]", ""), HasSubstr("resolution_px is missing"));
  EXPECT_THAT(setup_problem("[dome]\nradius_m = 5\n[[projector]]\nname = \"a\"\nresolution_px = [9, 9]\n"),
              HasSubstr("neither a lens nor a warp"));
  EXPECT_THAT(problem_with("blend_mask = \"north.png\"", ""), HasSubstr("is set without blend_mask"));
  EXPECT_THAT(problem_with("black_level_lift = [0.01, 0.02, 0.015]", ""), HasSubstr("without black_level_lift"));
}

TEST(DomeSetup, BrokenTomlIsAnErrorWithItsLine) {
  EXPECT_THAT(setup_problem("[dome]\nradius_m = = 5\n"), HasSubstr("dome.toml:2"));
  EXPECT_THAT(setup_problem("projector = 3\n[dome]\nradius_m = 5\n"), HasSubstr("not a list of tables"));
  EXPECT_THAT(setup_problem(std::string(5U << 20U, ' ')), HasSubstr("larger than 4 MiB"));
}

class DomeSetupFile : public test::FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
};

TEST_F(DomeSetupFile, MissingFilesAreErrorsWithTheLineThatNamesThem) {
  write("dome.toml", whole_setup);
  const auto problem = [&] { return error_of([&] { read_dome_setup(folder_ / "dome.toml"); }); };
  EXPECT_THAT(problem(), AllOf(HasSubstr("dome.toml:15"), HasSubstr("north.data, which does not exist")));
  write("north.data", "");
  EXPECT_THAT(problem(), AllOf(HasSubstr("dome.toml:16"), HasSubstr("north.png")));
  write("north.png", "");
  write("black.png", "");
  write("mirror.bin", "");
  EXPECT_EQ(problem(), "");
}

TEST_F(DomeSetupFile, OlderFileIsKeptBesideTheNewOne) {
  write("dome.toml", "an older one");
  write_dome_setup(folder_ / "dome.toml", parsed_setup(minimum));
  EXPECT_EQ(text("dome.toml.bak"), "an older one");
  EXPECT_EQ(read_dome_setup(folder_ / "dome.toml").projectors.size(), 1U);
}

TEST_F(DomeSetupFile, WithoutAnOlderFileNothingIsKept) {
  write_dome_setup(folder_ / "dome.toml", parsed_setup(minimum));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "dome.toml.bak"));
}

const std::string cluster_setup =
    minimum + "node = \"north\"\nmonitor = 0\n[[projector]]\nname = \"b\"\nmonitor = 0\nresolution_px = [640, 480]\n" +
    "fisheye = { fov_deg = 180 }\n[cluster]\naddress = \"eth1\"\nport = 9000\nsync = \"nv_swap_group\"\nkey = "
    "\"dome.key\"\n";

TEST(DomeSetupOfAClusterTest, IsReadAndWritten) {
  for (const DomeSetup& setup : {parsed_setup(cluster_setup), parsed_setup(to_toml(parsed_setup(cluster_setup)))}) {
    ASSERT_TRUE(setup.cluster);
    EXPECT_EQ(setup.cluster->address, "eth1");
    EXPECT_EQ(setup.cluster->port, 9000);
    EXPECT_EQ(setup.cluster->sync, SwapSync::nv_swap_group);
    EXPECT_EQ(setup.cluster->key, "dome.key");
    EXPECT_EQ(node_names(setup), std::vector<std::string>{"north"});
    ASSERT_EQ(part_of_setup(setup, "north").projectors.size(), 1U);
    EXPECT_EQ(part_of_setup(setup, "north").projectors[0].name, "a");
    EXPECT_EQ(part_of_setup(setup, "").projectors[0].name, "b");
  }
}

TEST(DomeSetupOfAClusterTest, NamesItsMistakes) {
  const auto problem = [](const std::string& from, const std::string& to) {
    std::string text = cluster_setup;
    text.replace(text.find(from), from.size(), to);
    return setup_problem(text);
  };
  EXPECT_THAT(problem("key = \"dome.key\"", ""), HasSubstr("--make-key"));
  EXPECT_THAT(problem("\"eth1\"", "\"*\""), HasSubstr("network interface"));
  EXPECT_THAT(problem("node = \"north\"", "node = \"north pole\""), HasSubstr("name of a computer"));
  EXPECT_THAT(problem("node = \"north\"", ""), HasSubstr("overlaps the output"));
  EXPECT_THAT(setup_problem(cluster_setup.substr(0, cluster_setup.find("[cluster]"))),
              HasSubstr("is missing, but projector a is at a node"));
}

}  // namespace
}  // namespace ergodome
