#include "app/commands/render/run_cost.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "content/show/reading/show_reader.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::CommandLine;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* short_show =
    "duration_s = 0.4\nframe_rate_hz = 10\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 8\n[sky]\nmap = \"sky.ppm\"\n"
    "[view]\nsize_px = 64\n";

TEST(RunCost, IsToldInWordsOfItsSize) {
  EXPECT_EQ(run_cost_text(1800, {1.0, 611'111}), "1,800 frames, about 1 s each: 30 min, 1.1 GB");
  EXPECT_EQ(run_cost_text(1, {0.5, 2'000}), "1 frame: about 0.5 s, 2 kB");
  EXPECT_EQ(run_cost_text(1'234'567, {0.25, 10'000'000}), "1,234,567 frames, about 0.25 s each: 3 d 13 h, 12 TB");
  EXPECT_EQ(run_cost_text(3, {0.001, 10}), "3 frames, about 10 ms or less each: 10 ms or less, 30 bytes");
}

TEST(DiskRoom, IsToldWhereItIsTooLittle) {
  EXPECT_EQ(room_note("frames", "the show", 1000, 1000), "");
  EXPECT_THAT(room_note("frames", "the rest of the run", 3'000'000'000, 200'000'000),
              StartsWith("frames: the rest of the run needs about 3 GB, but its disk has only 200 MB free; "));
  EXPECT_EQ(free_bytes("/nowhere/at/all") > 0, free_bytes("/") > 0);
}

TEST_F(CommandLine, PlanTakesAllFramesForTheOneInTheMiddle) {
  write("short.toml", short_show);
  ASSERT_EQ(run("plan short.toml --backend cpu --json"), 0) << output_;
  const auto estimate = nlohmann::json::parse(output_.substr(output_.find('{')))["estimate"];
  EXPECT_EQ(estimate["frames"], 4);
  EXPECT_EQ(estimate["measured_frame"], 3);
  EXPECT_GT(estimate["frame_s"].get<double>(), 0.0);
  EXPECT_GT(estimate["free_bytes"].get<double>(), 0.0);
  EXPECT_FALSE(fs::exists(folder_ / "frames"));
  // A frame that `render` writes contains the same picture as the measured one, and metadata.
  ASSERT_EQ(run("render short.toml --backend cpu --frames 3"), 0) << output_;
  const auto written = static_cast<double>(fs::file_size(folder_ / "frames/short_000003.png"));
  EXPECT_NEAR(estimate["frame_bytes"].get<double>(), written, 0.15 * written + 1500.0);
  EXPECT_EQ(estimate["run_bytes"].get<long>(), 4 * estimate["frame_bytes"].get<long>());
}

TEST_F(CommandLine, PlanMeasuresFilesOfTheFormatThatIsAskedFor) {
  write("short.toml", short_show);
  ASSERT_EQ(run("plan short.toml --backend cpu --format exr --stereo multiview --size 32"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("render: 4 frames, about "));
  EXPECT_THAT(output_, HasSubstr("measured on frame 3, in the middle of the show, written as exr"));
}

TEST_F(CommandLine, PlanNamesTheFrameThatItMeasured) {
  write("short.toml", short_show);
  const Show show = read_show(folder_ / "short.toml");
  ShowRenderer renderer(show, Backend::cpu);
  constexpr double never_slow_s = 1e9;
  constexpr double always_slow_s = 0.0;
  EXPECT_EQ(measured_frame(renderer, {}, {}, 2, never_slow_s).frame, 2);
  EXPECT_EQ(measured_frame(renderer, {}, {}, 2, always_slow_s).frame, 1);
  EXPECT_EQ(measured_frame(renderer, {}, {}, 0, always_slow_s).frame, 0);
}

TEST_F(CommandLine, UncompressedFramesTakeTheirPixelsBytes) {
  write("short.toml", short_show);
  ASSERT_EQ(run("render short.toml --backend cpu --frames 1 --out f --format exr --compression none"), 0) << output_;
  const auto written = static_cast<double>(fs::file_size(folder_ / "f/short_000001.exr"));
  const FrameFormat format = frame_format("exr", "none", false);
  const double expected = min_compressed_part(format) * static_cast<double>(uncompressed_bytes(format, 64 * 64));
  // In addition to the pixels, the file has 16 bytes per row (its number, size and offset) and a
  // header of at most 4096 bytes.
  EXPECT_GE(written, expected + 64 * 16);
  EXPECT_LE(written, expected + 64 * 16 + 4096);
}

TEST_F(CommandLine, RenderWarnsOfAFullDiskBeforeItsFirstFrame) {
  write("long.toml", std::string("duration_s = 1e8\n") + (std::strchr(short_show, '\n') + 1));
  // A file with the name of the left eye's folder makes the run fail at its first frame.
  fs::create_directory(folder_ / "f");
  write("f/L", "");
  const std::string separate = "render long.toml --backend cpu --out f --stereo separate --size 256 --format exr ";
  // A frame has 256 x 256 pixels, three channels of 2 bytes and two eyes, so 1e9 frames take 786
  // TB.
  EXPECT_NE(run(separate + "--compression none"), 0);
  EXPECT_THAT(output_, HasSubstr("f: the run needs about 786 TB, but its disk has only "));
  EXPECT_NE(run(separate), 0);
  EXPECT_THAT(output_,
              HasSubstr("f: the run, even if its frames compress to a tenth, needs about 79 TB, but its disk"));
  EXPECT_NE(run(separate + "--compression none --frames 1-100"), 0);
  EXPECT_THAT(output_, Not(HasSubstr("its disk has ")));
}

TEST_F(CommandLine, RenderTellsWhatARunTakesAfterItsFirstFrames) {
  write("short.toml", short_show);
  ASSERT_EQ(run("render short.toml --out f --backend cpu"), 0) << output_;
  EXPECT_THAT(output_, testing::ContainsRegex("ergodome: 4 frames, about .* each: .*B\n"));
  ASSERT_EQ(run("render short.toml --out f --backend cpu --from 100ms --to 0.2s"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("about")));
  EXPECT_THAT(output_, HasSubstr("1 frame in f\n"));
}

}  // namespace
}  // namespace ergodome
