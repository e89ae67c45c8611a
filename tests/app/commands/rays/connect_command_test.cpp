#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/cli/command_line.h"
#include "tests/support/csv_table.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(CommandLine, ConnectFindsTheRaysOfTheReferenceTable) {
  const std::string pairs = ERGODOME_TEST_DATA_DIR "/schwarzschild_pairs.csv";
  ASSERT_EQ(run("connect --pairs '" + pairs + "' --out out.csv"), 0) << output_;
  const auto expected = test::read_csv(pairs);
  const auto rows = test::read_csv(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("phi"), expected[i].at("phi"));
    EXPECT_EQ(rows[i].at("order"), expected[i].at("order"));
    EXPECT_NEAR(std::stod(rows[i].at("xi")), std::stod(expected[i].at("xi")), 1e-12);
    EXPECT_NEAR(std::stod(rows[i].at("travel_time")), std::stod(expected[i].at("travel_time")), 1e-10);
  }
}

TEST_F(CommandLine, ConnectReadsRaysFromATableToo) {
  const std::string pairs = ERGODOME_TEST_DATA_DIR "/schwarzschild_pairs.csv";
  ASSERT_EQ(run("connect --pairs '" + pairs + "' --out out.csv --method table --rows 128 --columns 128"), 0) << output_;
  const auto expected = test::read_csv(pairs);
  const auto rows = test::read_csv(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(std::stod(rows[i].at("xi")), std::stod(expected[i].at("xi")), 1e-6);
    EXPECT_NEAR(std::stod(rows[i].at("travel_time")), std::stod(expected[i].at("travel_time")), 1e-4);
  }
  write("third.csv", "r_obs,r,phi,order\n40,5,1,1\n40,5,1,3\n");
  ASSERT_EQ(run("connect --pairs third.csv --out third_read.csv --method table"), 0) << output_;
  ASSERT_EQ(run("connect --pairs third.csv --out third_exact.csv"), 0) << output_;
  EXPECT_NEAR(std::stod(test::read_csv(folder_ / "third_read.csv").at(1).at("xi")),
              std::stod(test::read_csv(folder_ / "third_exact.csv").at(1).at("xi")), 1e-7);
  write("far.csv", "r_obs,r,phi,order\n40,5e6,1,1\n");
  EXPECT_EQ(run("connect --pairs far.csv --out far_out.csv --method table"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("far.csv:2"), HasSubstr("closed_form")));
}

TEST_F(CommandLine, ConnectChoosesTheFormatByTheEnding) {
  write("pairs.csv", "r_obs,r,phi,order\n40,5,1,1\n");
  ASSERT_EQ(run("connect --pairs pairs.csv --out out.json"), 0) << output_;
  const auto rows = nlohmann::json::parse(std::ifstream(folder_ / "out.json"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["r_obs"], 40);
  EXPECT_GT(rows[0]["travel_time"], 35.0);
  EXPECT_EQ(run("connect --pairs pairs.csv --out out.png"), 2);
  EXPECT_THAT(output_, HasSubstr("choose a name that ends in .csv, .tsv or .json"));
}

TEST_F(CommandLine, ConnectNamesTheLineOfABadPairAndLeavesNoFile) {
  write("pairs.csv", "r_obs,r,phi,order\n40,5,1,1\n40,1.5,1,1\n");
  EXPECT_EQ(run("connect --pairs pairs.csv --out out.csv"), 1);
  EXPECT_THAT(output_, AllOf(HasSubstr("pairs.csv:3"), HasSubstr("r is 1.5")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.csv"));
}

}  // namespace
}  // namespace ergodome
