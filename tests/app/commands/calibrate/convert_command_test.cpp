#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/warps/warp_conversion.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::CommandLine;
using testing::HasSubstr;

constexpr const char* two_projectors =
    "[dome]\nradius_m = 6\nrotation_deg = 20\n"
    "[[projector]]\nname = \"left / one\"\nposition_m = [-1, 0, 0]\nyaw_deg = 40\npitch_deg = 40\n"
    "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [64, 48]\n"
    "window_px = [0, 0]\nblack_level_lift = 0.02\n"
    "[[projector]]\nname = \"right\"\nposition_m = [1, 0, 0]\nyaw_deg = -40\npitch_deg = 40\n"
    "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [64, 48]\n"
    "window_px = [64, 0]\n";

class ConvertCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("dome.toml", two_projectors);
  }
  [[nodiscard]] std::vector<ProjectorPicture> pictures_of(const char* setup) const {
    return projector_pictures(read_dome_setup(folder_ / setup));
  }
};

//! Compares two warps at the centers of those pixels that both of them draw. Returns the largest
//! distance between the positions in the master that they show.
double farthest_apart(const WarpMesh& a, const WarpMesh& b) {
  const WarpMesh fine_a = resampled_warp(a, 64, 48);
  const WarpMesh fine_b = resampled_warp(b, 64, 48);
  double farthest = 0.0;
  int both = 0;
  for (std::size_t i = 0; i < fine_a.nodes.size(); ++i) {
    if (fine_a.nodes[i].valid && fine_b.nodes[i].valid) {
      ++both;
      farthest = std::max(farthest, std::hypot(static_cast<double>(fine_a.nodes[i].u - fine_b.nodes[i].u),
                                               static_cast<double>(fine_a.nodes[i].v - fine_b.nodes[i].v)));
    }
  }
  EXPECT_GT(both, 64 * 48 / 2);
  return farthest;
}

TEST_F(ConvertCommand, AMeshWithoutNodesIsRefused) {
  ASSERT_EQ(run("convert dome.toml made"), 0) << output_;
  for (const char* size : {"0x0", "1x1", "-3x4"}) {
    EXPECT_NE(run("convert \"$(ls made/*.data | head -n 1)\" f.pfm --size=" + std::string(size)), 0) << size;
    EXPECT_THAT(output_, testing::HasSubstr("--size")) << size;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.pfm"));
}

TEST_F(ConvertCommand, AFolderOfMeshesShowsWhatTheSetupShows) {
  ASSERT_EQ(run("convert dome.toml made"), 0) << output_;
  const auto before = pictures_of("dome.toml");
  const auto after = pictures_of("made/dome.toml");
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(farthest_apart(before[i].warp, after[i].warp), 1e-5);
    EXPECT_EQ(after[i].black_level_lift.x, before[i].black_level_lift.x);
    for (std::size_t k = 0; k < before[i].blend.values.size(); ++k) {
      ASSERT_NEAR(after[i].blend.values[k], before[i].blend.values[k], 2e-5F) << k;
    }
  }
}

TEST_F(ConvertCommand, MpcdiAndBackShowsTheSame) {
  ASSERT_EQ(run("convert dome.toml made"), 0) << output_;
  ASSERT_EQ(run("convert made/dome.toml dome.mpcdi"), 0) << output_;
  ASSERT_EQ(run("convert dome.mpcdi sub/../again.toml --radius 6"), 1) << "there is no folder sub";
  ASSERT_EQ(run("convert dome.mpcdi again.toml --radius 6"), 0) << output_;
  const auto before = pictures_of("dome.toml");
  const auto after = pictures_of("again.toml");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(farthest_apart(before[i].warp, after[i].warp), 1e-5);
  }
}

TEST_F(ConvertCommand, MpcdiBecomesAFolderOfMeshes) {
  ASSERT_EQ(run("convert dome.toml made"), 0) << output_;
  ASSERT_EQ(run("convert made/dome.toml dome.mpcdi"), 0) << output_;
  ASSERT_EQ(run("convert dome.mpcdi again"), 0) << output_;
  EXPECT_LT(farthest_apart(pictures_of("dome.toml")[1].warp, pictures_of("again/dome.toml")[1].warp), 1e-5);
  EXPECT_NEAR(pictures_of("again/dome.toml")[0].black_level_lift.x, 0.02, 1e-4);
}

TEST_F(ConvertCommand, MeshesBecomeMapsAndMapsMeshes) {
  write("a.data",
        "2\n3 2\n-1.5 -1 0.1 0.2 1\n0 -1 0.5 0.2 1\n1.5 -1 0.9 0.2 1\n"
        "-1.5 1 0.1 0.8 1\n0 1 0.5 0.8 1\n1.5 1 0.9 0.8 1\n");
  ASSERT_EQ(run("convert a.data a.pfm --aspect 1.5 --size 20x10"), 0) << output_;
  ASSERT_EQ(run("convert a.pfm b.data --aspect 1.5"), 0) << output_;
  ASSERT_EQ(run("convert b.data c.pfm --aspect 1.5 --size 20x10"), 0) << output_;
  const FloatMap before = read_float_map(folder_ / "a.pfm", RowOrder::bottom_up);
  const FloatMap after = read_float_map(folder_ / "c.pfm", RowOrder::bottom_up);
  ASSERT_EQ(after.samples.size(), before.samples.size());
  for (std::size_t i = 0; i < before.samples.size(); ++i) {
    ASSERT_NEAR(after.samples[i], before.samples[i], 1e-5F) << i;
  }
}

TEST_F(ConvertCommand, WarpsOfOtherProgramsBecomeMeshes) {
  write("a.csv",
        "x;y;u;v;column;row\r\n0,0;0,0;0,1;0,2;0;0\r\n1,0;0,0;0,9;0,2;1;0\r\n0,0;1,0;0,1;0,7;0;1\r\n"
        "1,0;1,0;0,9;0,7;1;1\r\n");
  ASSERT_EQ(run("convert a.csv a.data --aspect 1.5"), 0) << output_;
  const WarpMesh mesh = read_bourke_mesh(folder_ / "a.data", 1.5);
  EXPECT_NEAR(mesh.at(1, 0).x, 1.0, 1e-6);
  EXPECT_NEAR(mesh.at(1, 0).u, 0.9, 1e-6);
  EXPECT_NEAR(mesh.at(1, 0).v, 0.2, 1e-6);
  ASSERT_EQ(run("convert a.csv a.pfm"), 0) << output_;
  EXPECT_NE(run("convert a.csv dome2.toml"), 0);
}

TEST_F(ConvertCommand, AViewBecomesAMeshOfTheDomemaster) {
  write("view.txt",
        "Dome Azimuth=20\nDome Elevation=45\nHorizontal FOV=70\nVertical FOV=50\n2 2\n0 0 0 0\n1 0 1 0\n0 1 0 1\n1 1 1 "
        "1\n");
  write("view.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"p\"\nresolution_px = [64, 48]\nwarp = \"view.txt\"\n");
  ASSERT_EQ(run("convert view.txt view.data --aspect 1.3333333333"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("yaw 20.00°, pitch 45.00°"));
  const WarpMesh mesh = read_bourke_mesh(folder_ / "view.data", 64.0 / 48.0);
  EXPECT_LT(farthest_apart(mesh, pictures_of("view.toml")[0].warp), 1e-5);
  ASSERT_EQ(run("inspect view.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("p: the warp file gives the view yaw 20.00°, pitch 45.00°"));
  EXPECT_NE(run("inspect view.txt"), 0);
  EXPECT_THAT(output_, HasSubstr("is a Sky-Skan warp; use it in a dome setup"));
}

TEST_F(ConvertCommand, SaysThatAMapHoldsNoIntensities) {
  const std::string head = "2\n2 2\n-2 -1 0 0 0.25\n2 -1 1 0 1\n-2 1 0 1 -1\n";
  write("a.data", head + "2 1 1 1 1\n");
  ASSERT_EQ(run("convert a.data a.pfm --aspect 2"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("a .pfm file stores no intensities, but a.data contains some from 0.25 to 1;"));
}

TEST_F(ConvertCommand, SaysNothingOfIntensitiesWhereAllAreFull) {
  write("a.data", "2\n2 2\n-2 -1 0 0 1\n2 -1 1 0 1\n-2 1 0 1 -1\n2 1 1 1 1\n");
  ASSERT_EQ(run("convert a.data a.pfm --aspect 2"), 0) << output_;
  EXPECT_THAT(output_, testing::Not(HasSubstr("intensities")));
}

//! Returns a polar mesh with 12 rings and 36 spokes that shows the circle of the domemaster, as
//! high as the projector's raster.
std::string polar_circle() {
  std::string mesh = "1\n36 12\n";
  for (int ring = 0; ring < 12; ++ring) {
    for (int spoke = 0; spoke < 36; ++spoke) {
      const double x = ring / 11.0 * std::cos(spoke * std::numbers::pi / 18.0);
      const double y = ring / 11.0 * std::sin(spoke * std::numbers::pi / 18.0);
      mesh += fmt::format("{} {} {} {} 1\n", x, y, 0.5 + 0.5 * x, 0.5 + 0.5 * y);
    }
  }
  return mesh;
}

TEST_F(ConvertCommand, APolarMeshLosesNextToNothingAsAMap) {
  write("a.data", polar_circle());
  ASSERT_EQ(run("convert a.data a.pfm"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("with 1280 x 720 samples"));
  const WarpMesh map =
      warp_from_map(read_float_map(folder_ / "a.pfm", RowOrder::bottom_up), TextureDirection::downwards);
  int drawn = 0;
  for (int row = 0; row + 1 < map.rows; ++row) {
    for (int column = 0; column + 1 < map.columns; ++column) {
      drawn += map.at(column, row).valid && map.at(column + 1, row).valid && map.at(column, row + 1).valid &&
                       map.at(column + 1, row + 1).valid
                   ? 1
                   : 0;
    }
  }
  const double polygon_px = 0.5 * 36 * std::sin(std::numbers::pi / 18.0) * 360.0 * 360.0;
  EXPECT_GT(drawn, 0.99 * polygon_px);
  EXPECT_LT(drawn, polygon_px);
}

TEST_F(ConvertCommand, APolarMeshOfAnUprightRasterBecomesAnUprightMap) {
  write("a.data", polar_circle());
  ASSERT_EQ(run("convert a.data a.pfm --aspect 0.5"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("with 720 x 1440 samples"));
}

//! Returns the setup of two projectors in a dome tilted by 15°; `rotation` is an additional line of
//! the [dome] table.
std::string leaning(const std::string& rotation) {
  std::string setup = two_projectors;
  setup.replace(setup.find("rotation_deg = 20"), 17, "tilt_deg = 15\n" + rotation);
  return setup;
}

TEST_F(ConvertCommand, ATiltWrittenBesideFlatWarpsOfMpcdiChangesNoShow) {
  write("dome.toml", leaning(""));
  ASSERT_EQ(run("convert dome.toml made"), 0) << output_;
  ASSERT_EQ(run("convert made/dome.toml a.mpcdi"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("its warps include tilt_deg and rotation_deg, which MPCDI does not store: for level "
                                 "test patterns, set tilt_deg = 15"));
  ASSERT_EQ(run("convert a.mpcdi again.toml --radius 6"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("set tilt_deg to make test patterns level"));
  std::string with_tilt = text("again.toml");
  with_tilt.replace(with_tilt.find("[dome]"), 6, "[dome]\ntilt_deg = 15");
  write("tilted.toml", with_tilt);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(farthest_apart(pictures_of("dome.toml")[i].warp, pictures_of("tilted.toml")[i].warp), 1e-5);
  }
}

TEST_F(ConvertCommand, ATiltWrittenBesidePlacesOfMpcdiTiltsShowsAgain) {
  write("dome.toml", leaning(""));
  ASSERT_EQ(run("convert dome.toml a.mpcdi"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("its positions include tilt_deg and rotation_deg, which MPCDI does not store: for "
                                 "level test patterns, keep the original setup"));
  ASSERT_EQ(run("convert a.mpcdi again.toml --radius 6"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("keep tilt_deg and rotation_deg at 0: shows are then correct"));
  EXPECT_LT(farthest_apart(pictures_of("dome.toml")[0].warp, pictures_of("again.toml")[0].warp), 1e-4);
  std::string with_tilt = text("again.toml");
  with_tilt.replace(with_tilt.find("[dome]"), 6, "[dome]\ntilt_deg = 15");
  write("tilted.toml", with_tilt);
  EXPECT_GT(farthest_apart(pictures_of("dome.toml")[0].warp, pictures_of("tilted.toml")[0].warp), 0.05);
}

TEST_F(ConvertCommand, WarpsWithARotationKeepTheirSetupForLevelPatterns) {
  write("dome.toml", leaning("rotation_deg = 20"));
  ASSERT_EQ(run("convert dome.toml made"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("test patterns are level only with the original setup"));
}

TEST_F(ConvertCommand, SaysNothingOfTiltWhereThereIsNone) {
  ASSERT_EQ(run("convert dome.toml a.mpcdi"), 0) << output_;
  EXPECT_THAT(output_, testing::Not(HasSubstr("tilt_deg")));
}

TEST_F(ConvertCommand, SaysWhatItCannotMake) {
  for (const char* words : {"convert dome.toml a.png", "convert a.png b.pfm", "convert dome.toml b.toml",
                            "convert absent.toml made", "convert absent.mpcdi made", "convert absent.data a.pfm",
                            "convert dome.toml", "convert dome.toml made --aspect 0"}) {
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
  EXPECT_FALSE(fs::exists(folder_ / "made"));
}

TEST_F(CommandLine, InspectTellsHowMuchOfTheDomeAProjectorLights) {
  // The projector is at the center, points straight up and has the frustum of a cube face. It
  // lights a sixth of the sphere, which is a third of the hemisphere.
  write("dome.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"up\"\npitch_deg = 90\n"
        "frustum = { left_deg = -45, right_deg = 45, up_deg = 45, down_deg = -45 }\nresolution_px = [256, 256]\n"
        "window_px = [0, 0]\n");
  ASSERT_EQ(run("inspect dome.toml --picture dome.png --size 200"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("33.3 %  from geometry"));
  EXPECT_THAT(output_, HasSubstr("66.7 % of the dome is lit by no projector"));
  EXPECT_TRUE(is_complete_image(folder_ / "dome.png", 200, 200));
}

TEST_F(CommandLine, InspectRefusesASetupWhoseFilesAreAbsent) {
  write("dome.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"up\"\nresolution_px = [256, 256]\nwarp = \"absent.data\"\n");
  EXPECT_EQ(run("inspect dome.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("absent.data"));
}

//! A setup with one projector, whose warp is a Bourke mesh.
constexpr const char* dome_with_a_mesh =
    "[dome]\nradius_m = 6\n[[projector]]\nname = \"m\"\nresolution_px = [320, 180]\nwarp = \"a.data\"\n";

//! Returns a Bourke mesh of 2 x 2 nodes whose x goes from -half_width to half_width.
std::string mesh_of_width(double half_width) {
  return fmt::format("2\n2 2\n-{0} -1 0.1 0.1 1\n{0} -1 0.9 0.1 1\n-{0} 1 0.1 0.9 1\n{0} 1 0.9 0.9 1\n", half_width);
}

TEST_F(CommandLine, InspectRemarksOnAMeshForARasterOfAnotherShape) {
  write("dome.toml", dome_with_a_mesh);
  write("a.data", mesh_of_width(1.3333333));
  ASSERT_EQ(run("inspect dome.toml"), 0) << output_;
  EXPECT_THAT(
      output_,
      HasSubstr("m: x in a.data extends to 1.333, but the raster's edges are at 1.778, so the edges stay black"));
  EXPECT_THAT(output_, HasSubstr("--aspect 1.3333"));
}

TEST_F(CommandLine, InspectNamesTheRangeOfAMeshThatRunsToOne) {
  write("dome.toml", dome_with_a_mesh);
  write("a.data", mesh_of_width(1.0));
  ASSERT_EQ(run("inspect dome.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("x_range = \"one\""));
}

TEST_F(CommandLine, InspectHasNoRemarkOnAMeshOfTheRastersShape) {
  write("dome.toml", dome_with_a_mesh);
  write("a.data", mesh_of_width(16.0 / 9.0));
  ASSERT_EQ(run("inspect dome.toml"), 0) << output_;
  EXPECT_THAT(output_, testing::Not(HasSubstr("runs to")));
}

TEST_F(CommandLine, AMeshIsNoSetupAndIsToBeNamedInOne) {
  write("a.data", mesh_of_width(1.0));
  write("a.pfm", "PF");
  for (const char* words : {"inspect a.data", "inspect a.pfm", "render grid-sky --setup a.data",
                            "play grid-sky --setup a.pfm", "calibrate a.data --out made"}) {
    EXPECT_EQ(run(words), 1) << words;
    EXPECT_THAT(output_, HasSubstr("is a warp mesh")) << words;
    EXPECT_THAT(output_, HasSubstr("warp = \"a.")) << words;
  }
}

}  // namespace
}  // namespace ergodome
