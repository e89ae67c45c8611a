#include <gmock/gmock.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "tests/app/cli/command_line.h"
#include "tests/support/csv_table.h"

namespace ergodome::test {
namespace {

using ::testing::HasSubstr;

class TraceDisk : public CommandLine {
 protected:
  //! Compares the crossings of traced rays with those listed in their table.
  void expect_crossings_of(const std::string& rays) {
    ASSERT_EQ(run("trace --disk --rays '" + rays + "' --out out.csv"), 0) << output_;
    std::map<std::string, CsvRow> traced;
    for (const CsvRow& row : read_csv(folder_ / "out.csv")) {
      traced[row.at("id") + "/" + row.at("order")] = row;
    }
    for (const CsvRow& want : read_csv(rays)) {
      const std::string key = want.at("id") + "/" + want.at("order");
      ASSERT_TRUE(traced.contains(key)) << key;
      const auto difference = [&](const char* column) {
        return std::stod(traced.at(key).at(column)) - std::stod(want.at(column));
      };
      EXPECT_LT(std::abs(difference("r_hit")), 1e-9) << key;
      EXPECT_LT(std::abs(std::remainder(difference("phi_hit"), 2.0 * pi)), 1e-9) << key;
      EXPECT_LT(std::abs(difference("delay")), 1e-9) << key;
      if (std::stod(want.at("g_kepler")) > 0.0) {
        EXPECT_LT(std::abs(difference("g_kepler")), 1e-9) << key;
      }
    }
  }
};

TEST_F(TraceDisk, GivesTheReferenceForEveryCrossing) { expect_crossings_of(ERGODOME_TEST_DATA_DIR "/disk.csv"); }

TEST_F(TraceDisk, GivesTheReferenceFromWithinTheHorizon) {
  expect_crossings_of(ERGODOME_TEST_DATA_DIR "/within_horizon_disk.csv");
}

TEST_F(CommandLine, TraceDiskGivesMatterInsideTheLastStableOrbitAShiftWhereItIsAskedTo) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0,20,0.3,zamo,-1,0.2,0\n");
  ASSERT_EQ(run("trace --disk --rays rays.csv --out out.csv"), 0) << output_;
  ASSERT_EQ(read_csv(folder_ / "out.csv").size(), 1U);
  const CsvRow row = read_csv(folder_ / "out.csv")[0];
  ASSERT_LT(std::stod(row.at("r_hit")), 6.0);
  EXPECT_EQ(row.at("g_kepler"), "");
  ASSERT_EQ(run("trace --disk --plunging --rays rays.csv --out out.csv"), 0) << output_;
  const double g = std::stod(read_csv(folder_ / "out.csv")[0].at("g_kepler"));
  EXPECT_GT(g, 0.0);
  EXPECT_LT(g, 1.0);
}

TEST_F(CommandLine, TraceDiskListsNothingForLightThatMeetsNoPlane) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,20,0.3,zamo,1,-0.3,0\n");
  ASSERT_EQ(run("trace --disk --rays rays.csv --out out.csv"), 0) << output_;
  EXPECT_TRUE(read_csv(folder_ / "out.csv").empty());
}

TEST_F(CommandLine, TraceDiskRefusesWhatItWouldNotHeed) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,20,0.3,zamo,-1,0,0\n");
  for (const char* words : {"--disk --method grid", "--disk --precision float", "--plunging"}) {
    EXPECT_NE(run(std::string("trace --rays rays.csv --out out.csv ") + words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("--disk")) << words;
  }
}

}  // namespace
}  // namespace ergodome::test
