#include <gmock/gmock.h>

#include <cmath>

#include "tests/app/cli/command_line.h"
#include "tests/support/csv_table.h"

namespace ergodome::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* sphere_show =
    "[hole]\nspin = 0\n[camera]\n[[camera.key]]\nt_s = 0\nr = 30\ntheta_deg = 90\nphi_deg = 0\n"
    "[[objects]]\nshape = \"sphere\"\nsize = 2\nkey = [{ t_s = 0, position = [12, 0, 0], ease = \"linear\" }, "
    "{ t_s = 10, position = [12, 0, 6] }]\n[sky]\nmap = \"grid\"\n";
constexpr const char* two_rays =
    "id,a,r,theta,observer,n_r,n_theta,n_phi\nmiddle,0,30,1.5707963267948966,static,-1,0,0\n"
    "up,0,30,1.5707963267948966,static,-0.8,-0.6,0\n";

TEST_F(CommandLine, TraceObjectsListsTheRaysThatMeetOne) {
  write("show.toml", sphere_show);
  write("rays.csv", two_rays);
  ASSERT_EQ(run("trace --objects show.toml --rays rays.csv --out out.csv"), 0) << output_;
  const auto rows = read_csv(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("id"), "middle");
  EXPECT_EQ(rows[0].at("object"), "0");
  EXPECT_NEAR(std::stod(rows[0].at("x")), 14.0, 0.02);
  // Along the spin axis, the travel time of light is the difference of the tortoise coordinates.
  const auto tortoise = [](double r) { return r + 2.0 * std::log(0.5 * r - 1.0); };
  EXPECT_NEAR(std::stod(rows[0].at("delay")), tortoise(30.0) - tortoise(std::stod(rows[0].at("x"))), 1e-9);
}

TEST_F(CommandLine, TraceObjectsLooksAtTheShowsTime) {
  write("show.toml", sphere_show);
  write("rays.csv", two_rays);
  ASSERT_EQ(run("trace --objects show.toml --at 10 --rays rays.csv --out out.csv"), 0) << output_;
  EXPECT_TRUE(read_csv(folder_ / "out.csv").empty());
}

TEST_F(CommandLine, TraceObjectsRefusesWhatCannotBe) {
  write("rays.csv", two_rays);
  EXPECT_EQ(run("trace --objects first-light --rays rays.csv --out out.csv"), 2);
  EXPECT_THAT(output_, HasSubstr("has no objects"));
  for (const char* words :
       {"--objects sphere --disk", "--objects sphere --shell 5", "--objects sphere --method grid"}) {
    EXPECT_NE(run(std::string("trace --rays rays.csv --out out.csv ") + words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("--objects")) << words;
  }
  EXPECT_NE(run("trace --objects sphere --at nan --rays rays.csv --out out.csv"), 0);
  EXPECT_THAT(output_, HasSubstr("--at: \"nan\" is not a number"));
  EXPECT_NE(run("trace --at 3 --rays rays.csv --out out.csv"), 0);
  EXPECT_THAT(output_, HasSubstr("--objects"));
}

}  // namespace
}  // namespace ergodome::test
