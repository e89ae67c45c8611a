#include "content/tables/pair_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "kernels/core/angles.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string pair_header = "r_obs,r,phi,order\n";

std::vector<PairRow> parsed_pairs(const std::string& text) {
  std::istringstream stream(text);
  return read_pair_table(stream, "pairs.csv");
}

std::string pair_problem(const std::string& text) {
  return test::error_of([&] { parsed_pairs(text); });
}

TEST(PairTable, ReadsTheReferenceTable) {
  const auto rows = read_pair_table(ERGODOME_TEST_DATA_DIR "/schwarzschild_pairs.csv");
  ASSERT_EQ(rows.size(), 72U);
  EXPECT_EQ(rows[1].text, "20,19.6298,4.007785307179586476925219,2");
  EXPECT_EQ(rows[1].angle, rows[1].phi);
}

TEST(PairTable, FindsColumnsByNameAndIgnoresOthers) {
  const auto rows = parsed_pairs("order,xi,phi,r,r_obs\n 2 ,7,+1.5,\"5\",40\r\n\n");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].r_observer, 40.0);
  EXPECT_EQ(rows[0].r, 5.0);
  EXPECT_EQ(rows[0].order, 2);
  EXPECT_EQ(rows[0].text, "40,5,+1.5,2");
}

TEST(PairTable, AnAzimuthMeansThePointWhicheverWayTheRayGoes) {
  const auto rows = parsed_pairs(pair_header + "40,5,1,2\n40,5,5,1\n40,5,1,3\n40,5,7.5,3\n40,5,6.283185307180,2\n");
  EXPECT_DOUBLE_EQ(rows[0].angle, 2.0 * pi - 1.0);
  EXPECT_DOUBLE_EQ(rows[1].angle, 2.0 * pi - 5.0);
  EXPECT_DOUBLE_EQ(rows[2].angle, 2.0 * pi + 1.0);
  EXPECT_EQ(rows[3].angle, 7.5);
  EXPECT_NEAR(rows[4].angle, 2.0 * pi, 1e-12);
}

TEST(PairTable, ProblemsNameTheLine) {
  EXPECT_THAT(pair_problem(""), HasSubstr("no header"));
  EXPECT_THAT(pair_problem("r_obs,r,phi\n"), AllOf(HasSubstr("pairs.csv:1"), HasSubstr("order")));
  EXPECT_THAT(pair_problem(pair_header + "40,5,1,1\n40,x,1,1\n"), AllOf(HasSubstr("pairs.csv:3"), HasSubstr("\"x\"")));
  EXPECT_THAT(pair_problem(pair_header + "40,nan,1,1\n"), HasSubstr("not a number"));
  EXPECT_THAT(pair_problem(pair_header + "40,-5,1,1\n"), AllOf(HasSubstr("r is -5"), HasSubstr("horizon")));
  EXPECT_THAT(pair_problem(pair_header + "2,5,1,1\n"), AllOf(HasSubstr("r_obs is 2"), HasSubstr("horizon")));
  EXPECT_THAT(pair_problem(pair_header + "1e13,5,1,1\n"), HasSubstr("1e12"));
  EXPECT_THAT(pair_problem(pair_header + "40,5,-0.1,1\n"), HasSubstr("phi is -0.1"));
  EXPECT_THAT(pair_problem(pair_header + "40,5,6.3,2\n"), HasSubstr("phi is 6.3"));
  EXPECT_THAT(pair_problem(pair_header + "40,5,1,0\n"), HasSubstr("order is 0"));
  EXPECT_THAT(pair_problem(pair_header + "40,5,1,1.5\n"), HasSubstr("order is 1.5"));
  EXPECT_THAT(pair_problem(pair_header + "40,5,1,17\n"), HasSubstr("16"));
  EXPECT_THAT(pair_problem(pair_header + "40,40,0,1\n"), HasSubstr("no light ray"));
  EXPECT_THAT(pair_problem(pair_header + "40,5,1\n"), HasSubstr("not a number"));
}

TEST(PairTable, MissingFileIsAnErrorWithItsName) {
  EXPECT_THAT(test::error_of([] { read_pair_table("no/such.csv"); }), HasSubstr("no/such.csv"));
}

}  // namespace
}  // namespace ergodome
