#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "content/files/whole_file.h"
#include "render/output/image_reader.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"
#include "tests/support/sanitized.h"

// Tests of the files that commands write, and of existing files that they must not change.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::CommandLine;
using testing::HasSubstr;
using testing::Not;

//! Returns the given command lines; under sanitizers only the first two, which cover the same code.
std::vector<std::string> some_of(std::vector<std::string> words) {
  words.resize(std::min(words.size(), test::sanitized ? std::size_t{2} : words.size()));
  return words;
}

const std::string tiny_show =
    "duration_s = 0.1\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 8\n[sky]\nmap = \"sky.ppm\"\n[view]\nsize_px = 48\n";

TEST_F(CommandLine, RenderResumesNoFramesThatWereAskedForDifferently) {
  write("small.toml", tiny_show);
  const std::string render = "render small.toml --out frames --frames 1:1 --backend cpu --resume";
  for (const std::string& options : some_of({"--format png", "--format tiff", "--format exr", "--format png --alpha",
                                             "--format png --from-outside", "--format exr --stereo multiview"})) {
    const std::string command = std::string(render).append(" ").append(options);
    ASSERT_EQ(run(command), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("1 frame in")) << options;
    // The second run of the same command skips the frame that the first run wrote.
    if (options.find(" --") != std::string::npos) {
      ASSERT_EQ(run(command), 0);
      EXPECT_THAT(output_, HasSubstr("0 frames in frames; skipped 1 frame from an earlier run")) << options;
    }
  }
  write("small.toml", tiny_show + "[tone]\nexposure_stops = 1\n");
  ASSERT_EQ(run(render), 0);
  EXPECT_THAT(output_, HasSubstr("1 frame in"));
  fs::last_write_time(folder_ / "sky.ppm", fs::last_write_time(folder_ / "sky.ppm") + std::chrono::seconds(2));
  ASSERT_EQ(run(render), 0);
  EXPECT_THAT(output_, HasSubstr("0 frames in")) << "it holds what it held";
}

TEST_F(CommandLine, OutputThatIsLostIsAFailureWithOneLine) {
  write("small.toml", tiny_show);
  for (const char* const command : {"inspect small.toml", "inspect small.toml --json", "--help"}) {
    EXPECT_EQ(run(std::string(command) + " >/dev/full 2>errors #"), 1) << command;
    EXPECT_THAT(text("errors"), HasSubstr("ergodome: cannot write the output: No space left on device")) << command;
    EXPECT_EQ(std::ranges::count(text("errors"), '\n'), 1) << command;
  }
}

TEST_F(CommandLine, ARenderGoesOnWithoutAStandardError) {
  write("small.toml", tiny_show + "[stereo]\nlayout = \"side_by_side\"\nbaseline = 0\n");
  for (const char* const to : {"2>/dev/full", "2>&-"}) {
    fs::remove_all(folder_ / "frames");
    run(std::string("render small.toml --out frames --frames 1:1 --backend cpu >out ").append(to).append(" #"));
    EXPECT_TRUE(fs::exists(folder_ / "frames/small_000001.png")) << to;
  }
}

TEST_F(CommandLine, RenderResumesFramesWhoseBudgetLeavesThingsOpen) {
  write("small.toml", tiny_show);
  const std::string render = "render small.toml --out frames --frames 1:1 --backend cpu --budget 9fps --resume";
  ASSERT_EQ(run(render), 0) << output_;
  for (int again = 0; again < 2; ++again) {
    ASSERT_EQ(run(render), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("0 frames in"));
  }
}

TEST_F(CommandLine, OutputsAreNoFilesThatAreRead) {
  const std::string rays = "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,6,1.2,zamo,1,0,0\n";
  write("small.toml", tiny_show);
  write("rays.csv", rays);
  fs::create_symlink("small.toml", folder_ / "link.toml");
  for (const std::string& command :
       some_of({"bake small.toml --out ./small.toml", "bake link.toml --out small.toml",
                "bake small.toml --out link.toml", "play small.toml --record small.toml",
                "trace --rays rays.csv --out rays.csv", "edge --rays rays.csv --out rays.csv",
                "connect --pairs rays.csv --out rays.csv", "catalogue rays.csv --out rays.csv",
                "convert rays.csv rays.csv", "calibrate small.toml --out c --mpcdi small.toml"})) {
    EXPECT_EQ(run(command), 2) << command;
    EXPECT_THAT(output_, HasSubstr("is also the input file")) << command;
  }
  EXPECT_EQ(run("inspect small.toml --picture small.toml"), 2);
  EXPECT_EQ(run("play small.toml --screenshot small.toml"), 2);
  EXPECT_EQ(run("play small.toml --record rays.csv"), 2);
  EXPECT_EQ(read_whole_file(folder_ / "small.toml", 10'000, ""), tiny_show);
  EXPECT_EQ(read_whole_file(folder_ / "rays.csv", 10'000, ""), rays);
}

TEST_F(CommandLine, RenderRefusesOptionsThatWouldChangeNothing) {
  write("small.toml", tiny_show);
  write("dome.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"up\"\npitch_deg = 90\nfisheye = { fov_deg = 90 }\n");
  for (const std::string& options :
       some_of({"--setup dome.toml --projection pinhole", "--setup dome.toml --from-outside",
                "--pattern checker --movie a.mp4", "--pattern checker --frames 1:2", "--pattern checker --view g",
                "--pattern checker --budget 1px", "--pattern checker --fps 30", "--pattern checker --resume",
                "--pattern checker --baseline 1", "--pattern checker --stereo mono --tint-eyes"})) {
    EXPECT_EQ(run("render small.toml --out o " + options), 2) << options;
    EXPECT_THAT(output_, HasSubstr("has no effect with --")) << options;
  }
  EXPECT_FALSE(fs::exists(folder_ / "o"));
}

TEST_F(CommandLine, RenderSaysWhereBothEyesSeeTheSame) {
  write("small.toml", tiny_show);
  const std::string render = "render small.toml --out o --frames 1:1 --backend cpu --stereo separate";
  ASSERT_EQ(run(render), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("both eyes see the same"));
  ASSERT_EQ(run(render + " --baseline 0.5"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("both eyes see the same")));
  const auto bytes_of = [&](const char* name) { return read_whole_file(folder_ / "o" / name, 1'000'000, ""); };
  EXPECT_NE(bytes_of("L/small_000001.png"), bytes_of("R/small_000001.png"));
  const auto metadata = nlohmann::json::parse(bytes_of("small.json"));
  EXPECT_EQ(metadata["baseline_M"], 0.5);
  EXPECT_EQ(metadata["files"][1], "R/small_000001.png");
}

TEST_F(CommandLine, RenderTellsWhichEyesFramesWereMadeFor) {
  write("near.toml",
        "duration_s = 0.1\n[hole]\nspin = 0\n[[camera.key]]\nr = 8\n[[camera.key]]\nt_s = 0.06\nr = 3\n[sky]\nmap = "
        "\"black\"\n[view]\nsize_px = 32\n[stereo]\nlayout = \"separate\"\nmodel = \"flat\"\nbaseline = 5\n"
        "convergence = 12\n");
  ASSERT_EQ(run("render near.toml --out o --backend cpu"), 0) << output_;
  const auto metadata = nlohmann::json::parse(read_whole_file(folder_ / "o" / "near.json", 1'000'000, ""));
  EXPECT_EQ(metadata["stereo_model"], "flat");
  EXPECT_EQ(metadata["convergence_M"], 12.0);
  const auto& baseline = metadata["baseline_M"];
  EXPECT_EQ(baseline["first"], 5.0);
  EXPECT_EQ(baseline["greatest"], 5.0);
  EXPECT_EQ(baseline["least"], baseline["last"]);
  // The expected baseline at the last camera position, r = 3 M, is (r - 2) / sqrt(1 - 2 / r).
  EXPECT_NEAR(baseline["last"].get<double>(), std::sqrt(3.0), 1e-3);
  const fs::path last = folder_ / "o" / "L" / "near_000003.png";
  EXPECT_NEAR(std::stod(metadata_of_image(last, "baseline_M")), baseline["last"].get<double>(), 1e-3);
  EXPECT_EQ(metadata_of_image(last, "stereo_model"), "flat");
  EXPECT_EQ(metadata_of_image(last, "convergence_M"), "12");
}

TEST_F(CommandLine, RenderWritesCaptionsInALanguage) {
  write("small.toml",
        "duration_s = 1\n[sky]\nmap = \"sky.ppm\"\n[[camera.key]]\nr = 8\n[view]\nsize_px = 200\n[[caption]]\nfrom_s = "
        "0\nto_s = "
        "1\ntext = { en = \"Light\", de = \"Schatten und Licht\" }\n");
  const auto rendered = [&](const std::string& language) {
    EXPECT_EQ(run("render small.toml --frames 15:15 --backend cpu --out o" + language), 0) << output_;
    return read_display_pixels(folder_ / "o/small_000015.png").values;
  };
  const auto english = rendered("");
  EXPECT_EQ(rendered(" --language en"), english);
  EXPECT_NE(rendered(" --language de"), english);
}

TEST_F(CommandLine, TellsACommandThatIsNoneByItsName) {
  EXPECT_EQ(run("rendr once-around"), 2);
  EXPECT_THAT(output_, HasSubstr("unknown command rendr; did you mean render?"));
  EXPECT_EQ(run("--frobnicate"), 2);
  EXPECT_THAT(output_, Not(HasSubstr("no command")));
  EXPECT_EQ(run("--help foo"), 0);
}

TEST_F(CommandLine, TellsFilesOfAnotherKind) {
  write("a.mpcdi", std::string("PK\x03\x04\0\0", 6));
  write("a.toml", std::string("PK\x03\x04\0\0", 6));
  EXPECT_EQ(run("render dome-still --setup a.mpcdi"), 1);
  EXPECT_THAT(output_, HasSubstr("ergodome convert a.mpcdi dome.toml"));
  EXPECT_EQ(run("render a.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("a.toml: is not a text file"));
}

TEST_F(CommandLine, InspectTellsWhatLooksIntoAFileThatIsNoShow) {
  write("stars.csv", "ra,dec,mag\n1,2,3\n");
  write("ship.obj", "v 0 0 0\n");
  write("words.mp3", "no sound");
  for (const auto& [file, remedy] :
       {std::pair("stars.csv", "ergodome catalogue stars.csv"), std::pair("ship.obj", "mesh = \"ship.obj\""),
        std::pair("words.mp3", "file = \"words.mp3\" in an [[audio]] table")}) {
    EXPECT_EQ(run(std::string("inspect ") + file), 1) << file;
    EXPECT_THAT(output_, HasSubstr(remedy));
  }
}

TEST_F(CommandLine, TellsACatalogueWithoutAStar) {
  write("stars.csv", "ra,dec,mag\n1,2,\n");
  EXPECT_EQ(run("catalogue stars.csv"), 1);
  EXPECT_THAT(output_, HasSubstr("stars.csv: contains no usable star: 1 row skipped"));
}

TEST_F(CommandLine, TellsOptionsThatWantAnother) {
  EXPECT_NE(run("play dome-still --no-control"), 0);
  EXPECT_THAT(output_, HasSubstr("requires --setup"));
  EXPECT_NE(run("play dome-still --idle 60"), 0);
  EXPECT_THAT(output_, HasSubstr("requires --exhibit"));
  EXPECT_NE(run("play dome-still --web-bind 0.0.0.0"), 0);
  EXPECT_THAT(output_, HasSubstr("requires --web"));
}

TEST_F(CommandLine, NamesTheSetupOfAProjectorThatLightsNothing) {
  write("dome.toml",
        "[dome]\nradius_m = 6\n[[projector]]\nname = \"down\"\npitch_deg = -80\nresolution_px = [64, 48]\nfrustum = { "
        "left_deg = -5, right_deg = "
        "5, up_deg = 5, "
        "down_deg = -5 }\n");
  EXPECT_EQ(run("calibrate dome.toml --out c"), 1);
  EXPECT_THAT(output_, HasSubstr("dome.toml:3, projector down: lights no part of the dome"));
}

}  // namespace
}  // namespace ergodome
