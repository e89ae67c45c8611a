#include <gmock/gmock.h>

#include <cmath>

#include "tests/app/cli/command_line.h"
#include "tests/support/csv_table.h"

namespace ergodome::test {
namespace {

using ::testing::HasSubstr;

TEST_F(CommandLine, TraceShellListsBothCrossingsOfLightThatTurns) {
  // Without spin, light stays in a plane through the hole. Here the plane contains the coordinates'
  // axis: θ goes from pole to pole, and the outward path is the mirror image of the inward path
  // about the turning point.
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0,20,1.5707963267948966,static,-0.8,0,0.6\n");
  ASSERT_EQ(run("trace --shell 15 --rays rays.csv --out out.csv"), 0) << output_;
  const auto rows = read_csv(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("crossing"), "0");
  EXPECT_EQ(rows[0].at("outwards"), "1");
  EXPECT_EQ(rows[1].at("crossing"), "1");
  EXPECT_EQ(rows[1].at("outwards"), "0");
  for (const CsvRow& row : rows) {
    EXPECT_NEAR(std::stod(row.at("theta_hit")), 1.5707963267948966, 1e-12);
    // Both the shell and the camera are static, so g is the ratio of their lapses.
    EXPECT_NEAR(std::stod(row.at("g_zamo")), std::sqrt((1.0 - 2.0 / 15.0) / (1.0 - 2.0 / 20.0)), 1e-12);
  }
  EXPECT_GT(std::stod(rows[1].at("delay")), std::stod(rows[0].at("delay")));
  EXPECT_GT(std::stod(rows[1].at("phi_hit")), std::stod(rows[0].at("phi_hit")));
}

TEST_F(CommandLine, TraceShellMeetsTheEquatorWhereTraceDiskDoes) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,20,0.6,zamo,-0.9,0.2,0.38\n");
  ASSERT_EQ(run("trace --disk --rays rays.csv --out disk.csv"), 0) << output_;
  const auto disk = read_csv(folder_ / "disk.csv");
  ASSERT_FALSE(disk.empty());
  ASSERT_EQ(run("trace --shell " + disk[0].at("r_hit") + " --rays rays.csv --out out.csv"), 0) << output_;
  double nearest = 1.0;
  for (const CsvRow& row : read_csv(folder_ / "out.csv")) {
    nearest = std::min(nearest, std::abs(std::stod(row.at("theta_hit")) - 1.5707963267948966) +
                                    std::abs(std::stod(row.at("phi_hit")) - std::stod(disk[0].at("phi_hit"))) +
                                    std::abs(std::stod(row.at("delay")) - std::stod(disk[0].at("delay"))));
  }
  EXPECT_LT(nearest, 1e-9);
}

TEST_F(CommandLine, TraceShellListsNothingForLightThatPassesBy) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,20,0.3,zamo,1,-0.3,0\n0.9,20,0.3,zamo,-1,1,0\n");
  ASSERT_EQ(run("trace --shell 5 --rays rays.csv --out out.csv"), 0) << output_;
  EXPECT_TRUE(read_csv(folder_ / "out.csv").empty());
}

TEST_F(CommandLine, TraceShellRefusesWhatCannotBe) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0,20,0.3,zamo,-1,0,0\n");
  EXPECT_NE(run("trace --shell 2 --rays rays.csv --out out.csv"), 0);
  EXPECT_THAT(output_, HasSubstr("inside the horizon"));
  EXPECT_THAT(output_, HasSubstr("choose a radius above 2"));
  for (const char* words : {"--shell 5 --disk", "--shell 5 --method grid", "--shell nan", "--shell -1"}) {
    EXPECT_NE(run(std::string("trace --rays rays.csv --out out.csv ") + words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("--shell")) << words;
  }
}

}  // namespace
}  // namespace ergodome::test
