#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "content/images/image_library.h"
#include "kernels/core/angles.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"
#include "tests/support/csv_table.h"
#include "tests/support/fits_reader.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::FitsReader;
using testing::HasSubstr;

//! Renders a show of two frames with a hole of spin 0.9 and a disk.
class ChannelFrames : public test::CommandLine {
 protected:
  static constexpr int size_px = 48;
  static constexpr const char* head = "duration_s = 0.1\ntitle = \"Numbers\"\n[hole]\nspin = 0.9\n";

  void SetUp() override {
    CommandLine::SetUp();
    write("numbers.toml", std::string(head) + R"([camera]
observer = "zamo"
[[camera.key]]
r = 12
theta_deg = 70
phi_deg = 30
yaw_deg = 5
[sky]
map = "sky.ppm"
[disk]
outer = 10
[view]
projection = "pinhole"
fov_deg = 90
size_px = 48
)");
  }

  [[nodiscard]] std::string frame(const std::string& folder, const std::string& ending = "fits") const {
    return (folder_ / folder / ("numbers_000001." + ending)).string();
  }
};

TEST_F(ChannelFrames, HoldTheNumbersThatTraceFindsForThePixelsRays) {
  ASSERT_EQ(run("render numbers.toml --frames 1 --out f --format fits --channels direction,g,sky,disk.0,disk.1"), 0)
      << output_;
  FitsReader fits(frame("f"));
  const auto channel = [&](const std::string& name) {
    fits.go_to(name);
    return fits.pixels();
  };
  const std::vector<double> n[3] = {channel("direction.r"), channel("direction.theta"), channel("direction.phi")};
  ASSERT_EQ(n[0].size(), static_cast<std::size_t>(size_px * size_px));
  std::string rays = "id,a,r,theta,observer,n_r,n_theta,n_phi\n";
  for (std::size_t i = 0; i < n[0].size(); i += 7) {
    rays += fmt::format("{},0.9,12,{:.17g},zamo,{:.17g},{:.17g},{:.17g}\n", i, 70.0 * one_degree, n[0][i], n[1][i],
                        n[2][i]);
  }
  write("rays.csv", rays);
  ASSERT_EQ(run("trace --rays rays.csv --out sky.csv --method closed_form"), 0) << output_;
  const std::vector<double> g = channel("g");
  const std::vector<double> longitude = channel("sky.longitude");
  int dark = 0;
  int lit = 0;
  for (const test::CsvRow& row : test::read_csv(folder_ / "sky.csv")) {
    const auto at = static_cast<std::size_t>(std::stoul(row.at("id")));
    if (row.at("status") != "escaped") {
      EXPECT_TRUE(std::isnan(g[at]) && std::isnan(longitude[at])) << at;
      ++dark;
      continue;
    }
    EXPECT_NEAR(g[at], std::stod(row.at("g")), 1e-12) << at;
    // The command `trace` sets the camera's azimuth to 0, the show to 30°.
    const double there = std::atan2(std::stod(row.at("sky_y")), std::stod(row.at("sky_x"))) + 30.0 * one_degree;
    EXPECT_NEAR(std::remainder(one_degree * longitude[at] - there, full_turn), 0.0, 1e-7) << at;
    ++lit;
  }
  EXPECT_GT(dark, 10);
  EXPECT_GT(lit, 100);
  ASSERT_EQ(run("trace --rays rays.csv --out disk.csv --disk"), 0) << output_;
  int on_disk = 0;
  for (const test::CsvRow& row : test::read_csv(folder_ / "disk.csv")) {
    const double r = std::stod(row.at("r_hit"));
    const auto at = static_cast<std::size_t>(std::stoul(row.at("id")));
    if (row.at("order") == "2" || row.at("g_kepler").empty() || r > 10.0) {
      continue;
    }
    const std::string layer = "disk." + row.at("order");
    EXPECT_NEAR(channel(layer + ".radius")[at], r, 1e-9) << at;
    EXPECT_NEAR(channel(layer + ".g")[at], std::stod(row.at("g_kepler")), 1e-9) << at;
    EXPECT_NEAR(channel(layer + ".delay")[at], std::stod(row.at("delay")), 1e-8) << at;
    const double turn = one_degree * (channel(layer + ".azimuth")[at] - 30.0) - std::stod(row.at("phi_hit"));
    EXPECT_NEAR(std::remainder(turn, full_turn), 0.0, 1e-9) << at;
    ++on_disk;
  }
  EXPECT_GT(on_disk, 30);
}

TEST_F(ChannelFrames, SayInTheirHeaderWhatTheyAreOf) {
  ASSERT_EQ(run("render numbers.toml --frames 1 --out f --format fits --channels g"), 0) << output_;
  FitsReader fits(frame("f"));
  fits.go_to_primary();
  EXPECT_EQ(fits.number("SPIN"), 0.9);
  EXPECT_NEAR(fits.number("CAM_R"), 12.0, 1e-12);
  EXPECT_NEAR(fits.number("CAM_THET"), 70.0, 1e-12);
  EXPECT_NEAR(fits.number("CAM_PHI"), 30.0, 1e-12);
  EXPECT_EQ(fits.text("OBSERVER"), "zamo");
  EXPECT_NEAR(fits.number("FWD_R"), -std::cos(5.0 * one_degree), 1e-12);
  EXPECT_NEAR(fits.number("FWD_P"), std::sin(5.0 * one_degree), 1e-12) << "a yaw to the right, where e_phi is";
  EXPECT_EQ(fits.number("UP_T"), -1.0);
  EXPECT_EQ(fits.text("PROJECT"), "pinhole");
  EXPECT_EQ(fits.text("OBJECT"), "Numbers");
  EXPECT_EQ(fits.number("DISK_OUT"), 10.0);
  EXPECT_EQ(fits.number("TOLERANC"), 1e-14);
  EXPECT_THAT(fits.text("CREATOR"), HasSubstr(ERGODOME_VERSION));
  fits.go_to("g");
  EXPECT_EQ(fits.text("CTYPE1"), "VLON-TAN");
  // The screen is 90° wide: at distance 1, it is 2 wide and has 48 pixels.
  EXPECT_NEAR(fits.number("CDELT1"), radian_deg * 2.0 / 48.0, 1e-12);
}

TEST_F(ChannelFrames, AreTheSameInExrAsFloats) {
  ASSERT_EQ(run("render numbers.toml --frames 1 --out f --channels g,order,color --backend cpu"), 0) << output_;
  ASSERT_EQ(run("render numbers.toml --frames 1 --out f --channels g,order,color --backend cpu --format fits"), 0)
      << output_;
  ASSERT_EQ(run("render numbers.toml --frames 1 --out picture --format exr --backend cpu"), 0) << output_;
  EXPECT_TRUE(is_complete_image(frame("f", "exr"), size_px, size_px));
  EXPECT_EQ(metadata_of_image(frame("f", "exr"), "spin"), "0.9");
  // The EXR file of the picture stores light as half floats, so it is compared with their
  // precision.
  FitsReader fits(frame("f"));
  fits.go_to("color.G");
  const std::vector<double> green = fits.pixels();
  std::string problem;
  const auto input = image_library().open(frame("picture", "exr"), {}, problem);
  ASSERT_TRUE(input) << problem;
  std::vector<float> rgb(3 * green.size());
  ASSERT_TRUE(input->read_all(3, rgb.data()));
  for (std::size_t i = 0; i < green.size(); ++i) {
    const std::size_t from_top = (size_px - 1 - i / size_px) * size_px + i % size_px;
    EXPECT_NEAR(green[i], static_cast<double>(rgb[3 * from_top + 1]), 1e-3 * green[i] + 1e-6) << i;
  }
}

TEST_F(ChannelFrames, AreLeftAloneByResumeWhereTheyAreWholeAndTheSame) {
  for (const std::string format : {"fits", "exr"}) {
    const std::string render = "render numbers.toml --out f --format " + format;
    ASSERT_EQ(run(render + " --channels g"), 0) << output_;
    ASSERT_EQ(run(render + " --channels g --resume"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("0 frames in f"));
    std::string bytes = text("f/numbers_000001." + format);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::ofstream(frame("f", format), std::ios::binary) << bytes;
    ASSERT_EQ(run(render + " --channels g --resume"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("1 frame in f"));
    ASSERT_EQ(run(render + " --channels sky --resume"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("3 frames in f"));
  }
}

TEST_F(ChannelFrames, AreThoseBetweenTheChosenTimes) {
  ASSERT_EQ(run("render numbers.toml --out f --format fits --channels g --from 0.05s --to 70ms"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("1 frame in f"));
  EXPECT_FALSE(fs::exists(frame("f")));
  EXPECT_TRUE(fs::exists(folder_ / "f/numbers_000003.fits"));
}

TEST_F(ChannelFrames, RefuseWhatTheyCannotBe) {
  write("plain.toml", std::string(head) + "[[camera.key]]\nr = 12\n[sky]\nmap = \"black\"\n");
  for (const char* words : {"numbers.toml --channels redshift", "numbers.toml --channels g,g",
                            "numbers.toml --channels g --format png", "numbers.toml --format fits",
                            "numbers.toml --channels g --compression dwaa", "numbers.toml --channels g --view g",
                            "numbers.toml --channels g --alpha", "numbers.toml --channels g --stereo side_by_side",
                            "numbers.toml --channels g --backend cpu", "numbers.toml --channels g --verify",
                            "numbers.toml --channels g --meter m", "numbers.toml --channels g --light m",
                            "numbers.toml --channels g --no-summary", "plain.toml --channels disk"}) {
    EXPECT_EQ(run(std::string("render ") + words + " --out refused"), 2) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
  }
  EXPECT_FALSE(fs::exists(folder_ / "refused"));
}

}  // namespace
}  // namespace ergodome
