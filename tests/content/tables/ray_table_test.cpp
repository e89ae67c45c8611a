#include "content/tables/ray_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string header = "a,r,theta,observer,n_r,n_theta,n_phi\n";

RayTable parsed_rays(const std::string& text) {
  std::istringstream stream(text);
  return read_ray_table(stream, "rays.csv");
}

std::string ray_problem(const std::string& text) {
  return test::error_of([&] { parsed_rays(text); });
}

TEST(RayTable, ReadsTheReferenceTable) {
  const RayTable table = read_ray_table(ERGODOME_TEST_DATA_DIR "/rays.csv");
  ASSERT_EQ(table.rows.size(), 806U);
  EXPECT_EQ(table.id_of(table.rows[3]), "3");
  EXPECT_EQ(table.camera_of(table.rows[48]).motion, ObserverMotion::velocity);
}

TEST(RayTable, RowsWithoutAVelocityHaveNone) {
  const RayTable table = parsed_rays(header + "0.5,6,1,zamo,1,0,0\n0.5,6,1,zamo,0,1,0");
  ASSERT_EQ(table.rows.size(), 2U);
  for (const RayRow& row : table.rows) {
    const RayCamera& camera = table.camera_of(row);
    EXPECT_EQ(camera.velocity.x, 0.0);
    EXPECT_EQ(camera.velocity.y, 0.0);
    EXPECT_EQ(camera.velocity.z, 0.0);
  }
}

TEST(RayTable, TakesTheMarkThatSpreadsheetsWriteFirst) {
  EXPECT_EQ(parsed_rays("\xEF\xBB\xBF" + header + "0.5,6,1,zamo,1,0,0\n").rows.size(), 1U);
}

TEST(RayTable, RefusesALineWithoutEndBeforeReadingItAll) {
  EXPECT_THAT(ray_problem(header + "0.5,6,1,zamo,1,0,0\n" + std::string(1'000'000, '1')),
              AllOf(HasSubstr("rays.csv:3"), HasSubstr("exceeds the limits")));
}

TEST(RayTable, FindsColumnsByNameAndIgnoresOthers) {
  const RayTable table = parsed_rays("n_phi,n_theta,n_r,note,observer,theta,r,a\n3,0,4,hello,rain,+1.0e+00,5,-0.5\r\n");
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.id_of(table.rows[0]), "0");
  EXPECT_EQ(table.camera_of(table.rows[0]).spacetime.spin, -0.5);
  EXPECT_EQ(table.camera_of(table.rows[0]).theta, 1.0);
  EXPECT_NEAR(table.rows[0].direction.x, 0.8, 1e-15);
  EXPECT_NEAR(table.rows[0].direction.z, 0.6, 1e-15);
}

TEST(RayTable, ReadsNumbersOfFortyDigitsAndTinyOnes) {
  const RayTable table =
      parsed_rays(header + "0.5,5,1,zamo,-7.27454632735125783505123456789012345678e-01,1e-340,6.8e-1\n");
  EXPECT_LT(table.rows[0].direction.x, 0.0);
  EXPECT_EQ(table.rows[0].direction.y, 0.0);
}

TEST(RayTable, ProblemsNameTheLine) {
  EXPECT_THAT(ray_problem(""), HasSubstr("no header"));
  EXPECT_THAT(ray_problem("a,r,theta,observer,n_r,n_theta\n"), AllOf(HasSubstr("rays.csv:1"), HasSubstr("n_phi")));
  EXPECT_THAT(ray_problem(header + "0,9,1,zamo,1,0,0\n0,x,1,zamo,1,0,0\n"),
              AllOf(HasSubstr("rays.csv:3"), HasSubstr("\"x\"")));
  EXPECT_THAT(ray_problem(header + "0,nan,1,zamo,1,0,0\n"), HasSubstr("not a number"));
  EXPECT_THAT(ray_problem(header + "0,9,1,zamo,inf,0,0\n"), HasSubstr("not a number"));
  EXPECT_THAT(ray_problem(header + "0,9,1,zamo,0,0,0\n"),
              HasSubstr("n_r, n_theta and n_phi are all 0, so the direction is undefined"));
  EXPECT_THAT(ray_problem(header + "0,9,1,zamo,1,nan,0\n"), HasSubstr("n_theta is \"nan\", not a number"));
  EXPECT_THAT(ray_problem(header + "0,9,1,zamo,1\n"), HasSubstr("not a number"));
  EXPECT_THAT(ray_problem(header + "0,1.9,1,zamo,1,0,0\n"), HasSubstr("horizon"));
  EXPECT_THAT(ray_problem(header + "1.1,9,1,zamo,1,0,0\n"), HasSubstr("a is 1.1"));
  EXPECT_THAT(ray_problem(header + "0,9,4,zamo,1,0,0\n"), HasSubstr("theta is 4"));
  EXPECT_THAT(ray_problem(header + "0,9,1,tourist,1,0,0\n"), HasSubstr("tourist"));
  EXPECT_THAT(ray_problem(header + "0.9,1.95,1.57,static,1,0,0\n"), HasSubstr("faster than light"));
  EXPECT_THAT(ray_problem(header + std::string(70'000, '1') + "\n"), HasSubstr("exceeds the limits"));
}

TEST(RayTable, TakesSpinAndDegreesByTheirColumnsNames) {
  const RayTable table =
      parsed_rays("spin,r,theta_deg,observer,n_r,n_theta,n_phi\n0.5,6,60,zamo,0,0,2\n-1,6,180,zamo,0,0,2\n");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.camera_of(table.rows[0]).spacetime.spin, 0.5);
  EXPECT_NEAR(table.camera_of(table.rows[0]).theta, 1.0471975511965976, 1e-15);
  EXPECT_EQ(table.rows[0].direction.z, 1.0);
  EXPECT_EQ(table.camera_of(table.rows[1]).spacetime.spin, -1.0);
  EXPECT_NEAR(table.camera_of(table.rows[1]).theta, 3.141592653589793, 1e-15);
  const std::string degrees = "spin,r,theta_deg,observer,n_r,n_theta,n_phi\n";
  EXPECT_THAT(ray_problem(degrees + "0.5,6,181,zamo,1,0,0\n"), HasSubstr("theta_deg is 181"));
  EXPECT_THAT(ray_problem(degrees + "0.5,6,x,zamo,1,0,0\n"), HasSubstr("theta_deg is \"x\""));
  EXPECT_THAT(ray_problem(degrees + "1.5,6,90,zamo,1,0,0\n"), HasSubstr("spin is 1.5"));
  EXPECT_THAT(ray_problem(header + "0.5,6,60,zamo,1,0,0\n"), HasSubstr("name the column theta_deg"));
  EXPECT_THAT(ray_problem("a,spin,r,theta,observer,n_r,n_theta,n_phi\n"), HasSubstr("both columns a and spin"));
  EXPECT_THAT(ray_problem("a,r,theta,theta_deg,observer,n_r,n_theta,n_phi\n"),
              HasSubstr("both columns theta and theta_deg"));
  EXPECT_THAT(ray_problem("r,theta,observer,n_r,n_theta,n_phi\n"), HasSubstr("no column a (nor spin)"));
}

TEST(RayTable, NothingInALineIsIgnored) {
  EXPECT_THAT(ray_problem(header + "0,9,1,zamo,1,0,0,7\n"), AllOf(HasSubstr("rays.csv:2"), HasSubstr("has 8 cells")));
  EXPECT_EQ(ray_problem(header + "0,9,1,zamo,1,0,0,,\n"), "");
  EXPECT_THAT(ray_problem("a,r,r,theta,observer,n_r,n_theta,n_phi\n0,9,9,1,zamo,1,0,0\n"),
              HasSubstr("has two columns r"));
  EXPECT_THAT(ray_problem("a,r,theta,observer,n_r,n_theta,n_phi,beta_phi\n0,9,1,zamo,1,0,0,0.5\n"),
              HasSubstr("has a velocity that differs from that of the observer zamo"));
}

TEST(RayTable, WhoIsBoostedNeedsAllColumnsOfTheVelocity) {
  for (const std::string observer : {"boost", "rain_boost"}) {
    const std::string row = "0.5,9,1," + observer + ",1,0,0,0.1,0.2,0.3\n";
    EXPECT_THAT(ray_problem("a,r,theta,observer,n_r,n_theta,n_phi,beta_r,beta_theta,beta_ph\n" + row),
                AllOf(HasSubstr("rays.csv:2"), HasSubstr("no column beta_phi"), HasSubstr(observer + ",")));
    EXPECT_EQ(ray_problem("a,r,theta,observer,n_r,n_theta,n_phi,beta_r,beta_theta,beta_phi\n" + row), "");
  }
}

TEST(RayTable, ReadsEveryRowOfALongTableWithItsCamera) {
  std::string text = "id," + header;
  constexpr int rows = 20'000;  // more than the reader takes from the file at once
  for (int i = 0; i < rows; ++i) {
    text += fmt::format("{0},0.5,{1},1,zamo,0,0,{0}.5\n", i, 6 + i / 3 % 2);
  }
  const RayTable table = parsed_rays(text);
  ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) {
    const RayRow& row = table.rows[static_cast<std::size_t>(i)];
    EXPECT_EQ(table.id_of(row), std::to_string(i));
    EXPECT_EQ(table.camera_of(row).r, 6 + i / 3 % 2);
    EXPECT_EQ(table.camera_of(row).spacetime.spin, 0.5);
    EXPECT_EQ(row.direction.z, 1.0);
  }
}

TEST(RayTable, MissingFileIsAnErrorWithItsName) {
  EXPECT_THAT(test::error_of([] { read_ray_table("no/such.csv"); }), HasSubstr("no/such.csv"));
}

}  // namespace
}  // namespace ergodome
