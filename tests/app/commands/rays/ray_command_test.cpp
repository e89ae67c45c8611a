#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/cli/command_line.h"
#include "tests/support/csv_table.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

//! Reads tables of rays as a user would write them.
class RayCommands : public test::CommandLine {};

TEST_F(RayCommands, TraceGivesTheReferenceForEveryRayByEveryExactMethod) {
  const std::string rays = ERGODOME_TEST_DATA_DIR "/rays.csv";
  const auto expected = test::read_csv(rays);
  for (const char* method : {"taylor", "closed_form"}) {
    ASSERT_EQ(run("trace --rays '" + rays + "' --out out.csv --method " + method), 0) << output_;
    const auto traced = test::read_csv(folder_ / "out.csv");
    ASSERT_EQ(traced.size(), expected.size());
    for (std::size_t i = 0; i < traced.size(); ++i) {
      const auto& want = expected[i];
      const auto& got = traced[i];
      ASSERT_EQ(got.at("id"), want.at("id"));
      ASSERT_EQ(got.at("status"), want.at("status")) << method << " " << want.at("id");
      const double g = std::stod(want.at("g"));
      EXPECT_NEAR(std::stod(got.at("g")), g, 1e-12 * std::abs(g)) << method << " " << want.at("id");
      if (want.at("status") == "escaped") {
        const auto difference = [&](const char* axis) { return std::stod(got.at(axis)) - std::stod(want.at(axis)); };
        const double error = std::hypot(difference("sky_x"), difference("sky_y"), difference("sky_z"));
        EXPECT_LT(error, 1e-10 + 1e-13 / std::abs(std::stod(want.at("edge_distance"))))
            << method << " " << want.at("id");
      }
    }
  }
}

TEST_F(RayCommands, AxesAreAsTheHelpSays) {
  // Without spin, light that is seen straight outwards comes from exactly that direction. At a
  // large radius r, light is bent by only about 2 M / r.
  write("rays.csv",
        "spin,r,theta_deg,observer,n_r,n_theta,n_phi,id\n0,10,90,zamo,5,0,0,out\n0,10,30,zamo,1,0,0,high\n"
        "0.9,1e9,60,zamo,0,3,0,south\n0.9,1e9,60,zamo,0,0,0.5,east\n");
  ASSERT_EQ(run("trace --rays rays.csv --out sky.csv"), 0) << output_;
  const auto rows = test::read_csv(folder_ / "sky.csv");
  const double half_root_3 = 0.5 * std::sqrt(3.0);
  const double expected[4][3] = {{1, 0, 0}, {0.5, 0, half_root_3}, {0.5, 0, -half_root_3}, {0, 1, 0}};
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(std::stod(rows[i].at("sky_x")), expected[i][0], 1e-8) << rows[i].at("id");
    EXPECT_NEAR(std::stod(rows[i].at("sky_y")), expected[i][1], 1e-8) << rows[i].at("id");
    EXPECT_NEAR(std::stod(rows[i].at("sky_z")), expected[i][2], 1e-8) << rows[i].at("id");
  }
}

TEST_F(RayCommands, EndingsOfOutChooseTheFormat) {
  write("rays.csv",
        "a,r,theta,observer,n_r,n_theta,n_phi,id\n0.9,6,1.2,zamo,-0.2,0.3,0.9,007\n0.9,6,1.2,zamo,-1,0,0,in\n");
  ASSERT_EQ(run("trace --rays rays.csv --out sky.csv"), 0) << output_;
  const auto csv = test::read_csv(folder_ / "sky.csv");
  ASSERT_EQ(run("trace --rays rays.csv --out sky.TSV"), 0) << output_;
  EXPECT_THAT(text("sky.TSV"), HasSubstr("007\tescaped\t" + csv[0].at("sky_x") + "\t"));
  ASSERT_EQ(run("trace --rays rays.csv --out sky.json"), 0) << output_;
  const nlohmann::json json = nlohmann::json::parse(text("sky.json"));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["id"], "007");
  EXPECT_EQ(json[0]["sky_x"].get<double>(), std::stod(csv[0].at("sky_x")));
  EXPECT_EQ(json[1]["status"], "captured");
  EXPECT_TRUE(json[1]["sky_x"].is_null());
  ASSERT_EQ(run("edge --rays rays.csv --out edge.json --points 4"), 0) << output_;
  EXPECT_EQ(nlohmann::json::parse(text("edge.json")).size(), 4U);
  EXPECT_EQ(run("edge --rays rays.csv --out edge.xlsx"), 2);
  EXPECT_THAT(output_, HasSubstr("choose a name that ends in .csv, .tsv or .json"));
}

TEST_F(RayCommands, TraceWorksByEveryMethodInBothPrecisions) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,6,1.2,zamo,-0.2,0.3,0.9\n0.9,6,1.2,zamo,-1,0,0\n");
  for (const char* method : {"taylor", "rk34", "cash_karp", "closed_form", "baseline_rk34"}) {
    for (const char* precision : {"float", "double"}) {
      // Options for tolerance and precision are given only to methods that follow rays in steps.
      // The closed form accepts neither.
      const std::string exact = std::string("trace --rays rays.csv --out out.csv --method ") + method;
      const bool follows = std::string(method) != "closed_form";
      ASSERT_EQ(run(follows ? exact + " --tolerance 1e-5 --precision " + precision : exact), 0) << output_;
      const auto rows = test::read_csv(folder_ / "out.csv");
      ASSERT_EQ(rows.size(), 2U);
      EXPECT_EQ(rows[0].at("status"), "escaped") << method;
      EXPECT_EQ(rows[1].at("status"), "captured") << method;
      EXPECT_EQ(rows[1].at("sky_x"), "");
    }
  }
}

TEST_F(RayCommands, TraceInClosedFormKnowsWhatTheHorizonsOfAnExtremalHoleDoToIt) {
  std::string rays = "a,r,theta,observer,n_r,n_theta,n_phi\n";
  for (const char* camera : {"1,1.5,1.57,zamo,", "-1,1.5,1.57,zamo,", "1,1.05,1,rain,", "1,6,1,zamo,"}) {
    for (int i = 0; i < 40; ++i) {
      const double z = (i + 0.5) / 20.0 - 1.0;
      const double across = std::sqrt(1.0 - z * z);
      rays += camera + std::to_string(z) + "," + std::to_string(across * std::cos(2.4 * i)) + "," +
              std::to_string(across * std::sin(2.4 * i)) + "\n";
    }
  }
  write("rays.csv", rays);
  ASSERT_EQ(run("trace --rays rays.csv --out exact.csv --method taylor"), 0) << output_;
  ASSERT_EQ(run("trace --rays rays.csv --out closed.csv --method closed_form"), 0) << output_;
  const auto exact = test::read_csv(folder_ / "exact.csv");
  const auto closed = test::read_csv(folder_ / "closed.csv");
  int sure = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ASSERT_EQ(exact[i].at("status"), closed[i].at("status")) << i;
    if (exact[i].at("status") == "escaped") {
      const auto difference = [&](const char* axis) {
        return std::stod(exact[i].at(axis)) - std::stod(closed[i].at(axis));
      };
      const double error = std::hypot(difference("sky_x"), difference("sky_y"), difference("sky_z"));
      EXPECT_LT(error, 1e-12 + std::stod(closed[i].at("error_estimate")) + std::stod(exact[i].at("error_estimate")))
          << i;
      sure += std::stod(closed[i].at("error_estimate")) < 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GE(sure, 90) << "it does not doubt what is good";
}

TEST_F(RayCommands, TraceTellsOfRaysThatDoNotConverge) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi,id\n0.9,10,1.57,zamo,-0.3,0.2,0.9,x\n");
  ASSERT_EQ(run("trace --rays rays.csv --out sky.csv --method baseline_rk34 --tolerance 1e-12"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("1 of 1 ray did not converge"));
  std::istringstream written(text("sky.csv"));
  std::string line;
  std::getline(written, line);
  std::getline(written, line);
  EXPECT_TRUE(line.starts_with("x,not_converged,,,,") && line.ends_with(",")) << line;
}

TEST_F(RayCommands, ThePublishedTracerFindsTheSkyWithItsPublishedTolerance) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi,id\n0,10,1.2,zamo,0.6,0.3,0.7,x\n");
  ASSERT_EQ(run("trace --rays rays.csv --out exact.csv --method closed_form"), 0) << output_;
  ASSERT_EQ(run("trace --rays rays.csv --out sky.csv --method baseline_rk34"), 0) << output_;
  const auto exact = test::read_csv(folder_ / "exact.csv");
  const auto sky = test::read_csv(folder_ / "sky.csv");
  ASSERT_EQ(sky.at(0).at("status"), "escaped");
  for (const char* axis : {"sky_x", "sky_y", "sky_z"}) {
    EXPECT_NEAR(std::stod(sky[0].at(axis)), std::stod(exact[0].at(axis)), 0.02) << axis;
  }
  // The article (on `baseline_rk34`) ends its rays after at most 2,000 steps.
  EXPECT_LT(std::stod(sky[0].at("steps")), 2000.0);
}

TEST_F(RayCommands, EdgeOfTheReferencePointsIsNowhere) {
  ASSERT_EQ(run("edge --rays '" ERGODOME_TEST_DATA_DIR "/edge.csv' --out out.csv"), 0) << output_;
  const auto rows = test::read_csv(folder_ / "out.csv");
  ASSERT_EQ(rows.size(), 1088U);
  for (const auto& row : rows) {
    EXPECT_LT(std::abs(std::stod(row.at("edge_distance"))), 1e-10);
  }
}

TEST_F(RayCommands, EdgeWritesPointsThatLieOnTheEdge) {
  write("camera.csv", "id,a,r,theta,observer,n_r,n_theta,n_phi\nmy camera,0.9,6,1.2,rain,1,0,0\n");
  ASSERT_EQ(run("edge --rays camera.csv --out points.csv --points 8"), 0) << output_;
  const auto points = test::read_csv(folder_ / "points.csv");
  ASSERT_EQ(points.size(), 8U);
  EXPECT_EQ(points[3].at("id"), "my camera");
  std::string rays = "a,r,theta,observer,n_r,n_theta,n_phi\n";
  for (const auto& point : points) {
    rays += "0.9,6,1.2,rain," + point.at("n_r") + "," + point.at("n_theta") + "," + point.at("n_phi") + "\n";
  }
  write("rays.csv", rays);
  ASSERT_EQ(run("edge --rays rays.csv --out out.csv"), 0);
  for (const auto& row : test::read_csv(folder_ / "out.csv")) {
    EXPECT_LT(std::abs(std::stod(row.at("edge_distance"))), 1e-13);
  }
}

TEST_F(RayCommands, TraceBuildsAGridOnceForEachCameraWhereverItsRowsStand) {
  const std::string header = "a,r,theta,observer,n_r,n_theta,n_phi,id\n";
  const std::string near = "0.5,8,1.2,zamo,-0.2,0.3,0.9,near\n";
  const std::string far = "0.5,12,1.2,zamo,-0.2,0.3,0.9,far\n";
  write("mixed.csv", header + near + far + near + far + near);
  ASSERT_EQ(run("trace --rays mixed.csv --out sky.csv --method grid --size 512"), 0) << output_;
  std::istringstream reported(output_);
  int grids = 0;
  for (std::string line; std::getline(reported, line);) {
    grids += line.starts_with("a 0.5 r ") ? 1 : 0;
  }
  EXPECT_EQ(grids, 2) << output_;
  const auto rows = test::read_csv(folder_ / "sky.csv");
  ASSERT_EQ(rows.size(), 5U);
  const char* const ids[] = {"near", "far", "near", "far", "near"};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("id"), ids[i]);
    EXPECT_EQ(rows[i].at("sky_x"), rows[i % 2].at("sky_x")) << i;
  }
  EXPECT_NE(rows[0].at("sky_x"), rows[1].at("sky_x"));
}

TEST_F(RayCommands, ProblemsInATableNameTheLineAndLeaveNoFile) {
  write("rays.csv", "a,r,theta,observer,n_r,n_theta,n_phi\n0.9,0.5,1.2,zamo,1,0,0\n");
  EXPECT_EQ(run("trace --rays rays.csv --out out.csv"), 1);
  EXPECT_THAT(output_, HasSubstr("rays.csv:2"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.csv"));
}

}  // namespace
}  // namespace ergodome
