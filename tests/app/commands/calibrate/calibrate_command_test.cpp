#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>

#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/projectors/projector_files.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::HasSubstr;

constexpr const char* dome_of_two =
    "[dome]\nradius_m = 6\ntilt_deg = 10\n"
    "[[projector]]\nname = \"left / one\"\nposition_m = [-1, 0, 0]\nyaw_deg = 40\npitch_deg = 40\n"
    "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [64, 48]\n"
    "window_px = [0, 0]\n"
    "[[projector]]\nname = \"right\"\nposition_m = [1, 0, 0]\nyaw_deg = -40\npitch_deg = 40\n"
    "frustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [64, 48]\n"
    "window_px = [64, 0]\n";

class CalibrateCommand : public CommandLine {};

TEST_F(CalibrateCommand, WritesASetupWhoseProjectorsHaveWarpsAndMasks) {
  write("dome.toml", dome_of_two);
  ASSERT_EQ(run("calibrate dome.toml --out made --size 512"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("left / one"));
  const DomeSetup setup = read_dome_setup(folder_ / "made" / "dome.toml");
  ASSERT_EQ(setup.projectors.size(), 2U);
  for (const ProjectorSetup& projector : setup.projectors) {
    const LoadedProjector files = load_projector(setup, projector);
    EXPECT_TRUE(std::holds_alternative<WarpMesh>(files.warp));
    ASSERT_TRUE(files.blend);
    EXPECT_EQ(files.blend->map.width, 64);
  }
}

TEST_F(CalibrateCommand, LightsAllOfTheDomeOfTheExample) {
  ASSERT_EQ(run("calibrate '" ERGODOME_TEST_DATA_DIR
                "/../../calibration/examples/three-projectors.toml' --out made --size 512"),
            0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("\n0.0 % of the dome is lit by no projector\n"));
  ASSERT_EQ(run("inspect made/three-projectors.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("\n0.0 % of the dome is lit by no projector\n"));
}

TEST_F(CalibrateCommand, AndInspectTellTheSamePartsOfTheDome) {
  // The warp meshes extend beyond the image circle of the fisheye lens, which emits no light there.
  write("dome.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"up\"\npitch_deg = 90\nfisheye = { fov_deg = 90 }\n"
        "resolution_px = [256, 128]\nwindow_px = [0, 0]\n");
  ASSERT_EQ(run("calibrate dome.toml --out made --size 512"), 0) << output_;
  // The projector lights a cap of half angle 45°, which is 1 - cos 45° of the hemisphere.
  EXPECT_THAT(output_, HasSubstr("29.3 % of the dome\n70.7 % of the dome is lit by no projector"));
  ASSERT_EQ(run("inspect made/dome.toml"), 0) << output_;
  EXPECT_THAT(output_, testing::ContainsRegex("yes +29.[0-6] %"));
}

TEST_F(CalibrateCommand, AndInspectCountTheCellsThatAreDrawn) {
  // Mesh cells that cross the edge of the mirror are not drawn, so the meshes light less of the
  // dome than the mirror does.
  write("dome.toml",
        "[dome]\nradius_m = 8\n[[projector]]\nname = \"a\"\n"
        "frustum = { left_deg = -10, right_deg = 10, up_deg = 12, down_deg = -12 }\n"
        "mirror = { position_m = [0, 0, -1.5], radius_m = 0.3 }\nresolution_px = [160, 120]\nwindow_px = [0, 0]\n");
  ASSERT_EQ(run("calibrate dome.toml --out made"), 0) << output_;
  const std::string calibrated = output_.substr(output_.find("nodes, ") + 7, 4);
  ASSERT_EQ(run("inspect dome.toml"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr(" " + calibrated + " %"));
}

TEST_F(CalibrateCommand, TellsOfAProjectorWhoseLightPassesTheDomeBy) {
  // The front of the dome's rim is 10 degrees below the horizon, but the projector lights only
  // directions more than 9 degrees below it.
  write("dome.toml", std::string(dome_of_two) +
                         "[[projector]]\nname = \"floor\"\npitch_deg = -44\n"
                         "frustum = { left_deg = -5, right_deg = 5, up_deg = 35, down_deg = -35 }\n"
                         "resolution_px = [32, 32]\nwindow_px = [200, 0]\n");
  ASSERT_EQ(run("calibrate dome.toml --out made --size 512"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("floor lights almost none of the dome"));
}

//! Returns the setup of a dome of 6 m radius with a projector that is outside the dome, behind it,
//! and points to the front.
std::string dome_with_one_behind(double tilt_deg) {
  return fmt::format(
      "[dome]\nradius_m = 6\ntilt_deg = {}\n[[projector]]\nname = \"behind\"\nposition_m = [0, 0, 7]\npitch_deg = 20\n"
      "frustum = {{ left_deg = -30, right_deg = 30, up_deg = 30, down_deg = -30 }}\nresolution_px = [32, 32]\n"
      "window_px = [0, 0]\n",
      tilt_deg);
}

TEST_F(CalibrateCommand, RefusesAProjectorBehindTheDomesShellAsInspectDoes) {
  // The dome is tilted backwards, so that the back of its rim is below the projector.
  write("dome.toml", dome_with_one_behind(-20.0));
  for (const char* words :
       {"calibrate dome.toml --out made", "inspect dome.toml", "render --pattern white --setup dome.toml"}) {
    EXPECT_EQ(run(words), 1) << words;
    EXPECT_THAT(output_, HasSubstr("dome.toml:4, projector behind: is outside the dome, whose shell blocks its light"));
  }
}

TEST_F(CalibrateCommand, RemarksOnAProjectorBehindTheDomesRaisedRimAsInspectDoes) {
  write("dome.toml", dome_with_one_behind(30.0));
  for (const char* words : {"calibrate dome.toml --out made", "inspect dome.toml"}) {
    EXPECT_EQ(run(words), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("behind is outside the dome's sphere")) << words;
  }
}

TEST_F(CalibrateCommand, SaysThatMpcdiDoesNotTellTheTilt) {
  write("dome.toml", dome_of_two);
  ASSERT_EQ(run("calibrate dome.toml --out made --size 512 --mpcdi made.mpcdi"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("for level test patterns, set tilt_deg = 10 in setups converted from it"));
}

TEST_F(CalibrateCommand, KeepsWhatTheSetupsOwnFolderHeld) {
  write("dome.toml", dome_of_two);
  write("2_right.data", "measured by hand");
  ASSERT_EQ(run("calibrate dome.toml --out . --size 512"), 0) << output_;
  EXPECT_EQ(text("2_right.data.bak"), "measured by hand");
  EXPECT_EQ(text("dome.toml.bak"), dome_of_two);
}

TEST_F(CalibrateCommand, WritesAnMpcdiCalibrationOfTheSame) {
  write("dome.toml", dome_of_two);
  ASSERT_EQ(run("calibrate dome.toml --out made --size 512 --mpcdi made.mpcdi"), 0) << output_;
  const Mpcdi mpcdi = read_mpcdi(folder_ / "made.mpcdi");
  EXPECT_EQ(mpcdi.profile, MpcdiProfile::media_2d);
}

TEST_F(CalibrateCommand, WritesNothingWhereOneFileCannotBeWritten) {
  write("dome.toml", dome_of_two);
  std::filesystem::create_directories(folder_ / "made" / "2_right_blend.png");
  EXPECT_NE(run("calibrate dome.toml --out made --size 512"), 0);
  EXPECT_THAT(output_,
              HasSubstr("made/2_right_blend.png: cannot be written: a directory or device with that name exists"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made" / "1_left___one.data"));
}

TEST_F(CalibrateCommand, WritesNothingWhereTheMpcdiHasNoPlace) {
  write("dome.toml", dome_of_two);
  EXPECT_NE(run("calibrate dome.toml --out made --size 512 --mpcdi dome.toml/a.mpcdi"), 0);
  EXPECT_THAT(output_, HasSubstr("the folder dome.toml does not exist"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made"));
}

TEST_F(CalibrateCommand, WritesNothingWhereALaterProjectorLightsNoPartOfTheDome) {
  std::string second_away = dome_of_two;
  second_away.replace(second_away.rfind("pitch_deg = 40"), 14, "pitch_deg = -80");
  write("dome.toml", second_away);
  EXPECT_NE(run("calibrate dome.toml --out made --size 512"), 0);
  EXPECT_THAT(output_, HasSubstr("lights no part of the dome"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made"));
}

TEST_F(CalibrateCommand, ReadsTheBlackLevelsMaskBeforeItWritesAnything) {
  std::string with_mask = dome_of_two;
  with_mask += "black_level_mask = \"torn.png\"\nblack_level_lift = [0.01, 0.01, 0.01]\n";
  write("dome.toml", with_mask);
  write("torn.png", "no image");
  EXPECT_NE(run("calibrate dome.toml --out made --size 512"), 0);
  EXPECT_THAT(output_, HasSubstr("torn.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made"));
}

TEST_F(CalibrateCommand, RefusesASetupThatItCannotCompute) {
  write("lensless.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"p\"\nresolution_px = [64, 48]\nwarp = \"a.data\"\n");
  write("a.data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n");
  write("away.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"p\"\nresolution_px = [64, 48]\npitch_deg = -80\n"
        "frustum = { left_deg = -10, right_deg = 10, up_deg = 5, down_deg = -5 }\n");
  for (const char* words : {"calibrate", "calibrate nothing.toml --out made", "calibrate lensless.toml --out made",
                            "calibrate away.toml --out made", "calibrate away.toml --out made --size 1",
                            "calibrate away.toml --out made --evenness 2", "calibrate away.toml",
                            "calibrate away.toml --out away.toml", "calibrate away.toml --out made --tolerance nan"}) {
    EXPECT_NE(run(words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made" / "lensless.toml"));
}

}  // namespace
}  // namespace ergodome
