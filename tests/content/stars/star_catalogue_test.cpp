#include "content/stars/star_catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "content/files/bytes.h"
#include "content/stars/star_file.h"
#include "content/stars/star_table.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

StarCatalogue parsed_stars(const std::string& text) {
  std::istringstream stream(text);
  return parse_star_table(stream, "stars.csv");
}

std::string catalogue_problem(const std::string& text) {
  return test::error_of([&] { parsed_stars(text); });
}

StarCatalogue built_in(const std::string& name) {
  Show show;
  show.sky.stars = name;
  return load_stars(show);
}

const CatalogueStar& star(const StarCatalogue& catalogue, std::uint32_t number) {
  return *std::ranges::find(catalogue.stars, number, &CatalogueStar::number);
}

TEST(StarCatalogue, BuiltInStarsAreTheHipparcosStars) {
  const StarCatalogue all = built_in("all_stars");
  ASSERT_EQ(all.stars.size(), 118'216U);
  EXPECT_EQ(std::ranges::count_if(all.stars, [](const CatalogueStar& s) { return std::isnan(s.b_v); }), 1279);
  // Published values of four stars with different positions and colors.
  const CatalogueStar& sirius = star(all, 32349);
  EXPECT_NEAR(sirius.v_mag, -1.44F, 1e-6F);
  EXPECT_NEAR(sirius.b_v, 0.009F, 1e-6F);
  EXPECT_NEAR(sirius.ra_deg, 101.2872, 1e-6);
  EXPECT_NEAR(sirius.dec_deg, -16.7161, 1e-6);
  EXPECT_NEAR(star(all, 91262).ra_deg, 360.0 - 80.7653, 1e-6);
  EXPECT_NEAR(star(all, 27989).b_v, 1.500F, 1e-6F);
  EXPECT_NEAR(star(all, 11767).dec_deg, 89.2641, 1e-6);
}

TEST(StarCatalogue, BrightStarsAreThoseThatTheEyeSees) {
  const StarCatalogue bright = built_in("bright_stars");
  EXPECT_GT(bright.stars.size(), 8'500U);
  EXPECT_LT(bright.stars.size(), 9'200U);
  EXPECT_LE(bright.stars.back().v_mag, 6.5F);
  EXPECT_TRUE(std::ranges::is_sorted(bright.stars, {}, &CatalogueStar::v_mag));
}

TEST(StarCatalogue, NoNameIsNoStars) { EXPECT_TRUE(built_in("").stars.empty()); }

TEST(StarCatalogue, PlacesAreEquatorialDirections) {
  const Vector3<double> pole = equatorial_direction(123.0, 90.0);
  EXPECT_NEAR(pole.z, 1.0, 1e-15);
  const Vector3<double> six_hours = equatorial_direction(90.0, 0.0);
  EXPECT_NEAR(six_hours.y, 1.0, 1e-15);
}

TEST(StarTable, ReadsItsOwnColumnsInAnyOrder) {
  const StarCatalogue read = parsed_stars("v_mag,b_v,dec_deg,hip,ra_deg\n2.5,0.6,-10,7,350.25\n-1.4,,20,8,-10\n");
  ASSERT_EQ(read.stars.size(), 2U);
  EXPECT_EQ(read.stars[0].number, 8U);
  EXPECT_TRUE(std::isnan(read.stars[0].b_v));
  EXPECT_DOUBLE_EQ(read.stars[0].ra_deg, 350.0);
  EXPECT_EQ(read.stars[1].number, 7U);
  EXPECT_DOUBLE_EQ(read.stars[1].dec_deg, -10.0);
}

TEST(StarTable, ReadsHygWithHoursQuotesAndTheSunLeftOut) {
  const StarCatalogue read = parsed_stars(
      "\"id\",\"hip\",\"proper\",\"ra\",\"dec\",\"dist\",\"mag\",\"ci\"\r\n"
      "0,,\"Sol\",0.0,0.0,0.0,-26.7,0.656\r\n"
      "32263,32349,\"Sirius, the \"\"dog\"\"\",6.752481,-16.716116,2.6371,-1.44,0.009\r\n");
  ASSERT_EQ(read.stars.size(), 1U);
  EXPECT_EQ(text_of(read.left_out), "1 row skipped: 1 row for the Sun (line 2)");
  EXPECT_FALSE(lacks_stars(read.left_out));
  EXPECT_NEAR(read.stars[0].ra_deg, 101.2872, 1e-4);
  EXPECT_EQ(read.stars[0].number, 32263U);
}

TEST(StarTable, RowsWithoutPlaceOrMagnitudeAreCountedByCauseWithTheFirstLine) {
  const StarCatalogue read = parsed_stars("ra_deg,dec_deg,v_mag\n1,2,3\n1,2,nan\n,2,3\n1,inf,3\n1,2\n,2,3\n");
  EXPECT_EQ(read.stars.size(), 1U);
  EXPECT_EQ(
      text_of(read.left_out),
      "5 rows skipped: 2 rows without a magnitude (first in line 3), 3 rows without a position (first in line 4)");
  EXPECT_TRUE(lacks_stars(read.left_out));
}

TEST(StarTable, AStarWithoutADistanceIsNotTheSun) {
  const StarCatalogue read = parsed_stars("ra_deg,dec_deg,v_mag,dist\n37.9,89.2,1.98,0\n0,0,-26.7,0\n");
  ASSERT_EQ(read.stars.size(), 1U);
  EXPECT_EQ(read.stars[0].v_mag, 1.98F);
}

TEST(StarTable, StarsThatAQuoteSwallowsAreCounted) {
  for (const char* const text : {"ra_deg,dec_deg,v_mag,name\n1,2,3,\"Sirius\n4,5,6,\"Vega\"\n7,8,9,Mira\n",
                                 "name,ra_deg,dec_deg,v_mag\n\"Sirius,1,2,3\n\"Vega\",4,5,6\nMira,7,8,9\n"}) {
    const StarCatalogue read = parsed_stars(text);
    EXPECT_EQ(read.stars.size(), 2U) << text;
    EXPECT_EQ(text_of(read.left_out),
              "1 row skipped: 1 row inside quotation marks that are closed on another line (line 2)")
        << text;
  }
}

TEST(StarTable, AnEndOfALineWithinANameIsNoMistakeAndIsCountedAsALine) {
  const StarCatalogue read = parsed_stars("ra_deg,dec_deg,v_mag,name\n1,2,3,\"Sir,\nius\"\n4,5,,x\n");
  EXPECT_EQ(read.stars.size(), 1U);
  EXPECT_EQ(text_of(read.left_out), "1 row skipped: 1 row without a magnitude (line 4)");
}

TEST(StarTable, HeaderAloneIsACatalogueWithoutStars) {
  EXPECT_TRUE(parsed_stars("ra_deg,dec_deg,v_mag\n").stars.empty());
}

TEST(StarTable, ByteOrderMarkAndMissingLastNewlineDoNoHarm) {
  EXPECT_EQ(parsed_stars("\xEF\xBB\xBFra_deg,dec_deg,v_mag\n1,2,3").stars.size(), 1U);
}

TEST(StarTable, EmptyFileIsAnError) { EXPECT_THAT(catalogue_problem(""), HasSubstr("stars.csv: is empty")); }

TEST(StarTable, MissingColumnIsToldWithAllNames) {
  EXPECT_THAT(catalogue_problem("ra_deg,mag\n1,2\n"),
              AllOf(HasSubstr("stars.csv:1: has no column for a declination; "), HasSubstr("for example dec_deg; "),
                    HasSubstr("reference/star-tables.md")));
}

TEST(StarTable, BytesThatATerminalDoesNotShowAreToldByTheirNumbers) {
  EXPECT_THAT(catalogue_problem(std::string("ra_deg,dec_deg,v_mag\n\0\0,2,3\n", 29)),
              HasSubstr("has \"\\x00\\x00\" where a right ascension is expected"));
}

TEST(StarTable, ANumberOfMoreThanOneLineIsAnErrorInOneLine) {
  const std::string problem = catalogue_problem("ra_deg,dec_deg,v_mag\n1,\"2\n3\",4\n");
  EXPECT_THAT(problem,
              AllOf(HasSubstr("stars.csv:2"), HasSubstr("spans several lines where a declination is expected")));
  EXPECT_THAT(problem, Not(HasSubstr("\n")));
}

TEST(StarTable, TextForANumberIsAnErrorWithItsLine) {
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,v_mag\n1,2,3\n1,two,3\n"),
              AllOf(HasSubstr("stars.csv:3"), HasSubstr("two"), HasSubstr("a declination is expected")));
}

TEST(StarTable, CellsWithoutAColumnAndColumnsGivenTwiceAreErrors) {
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,v_mag\n1,2,3,4\n"),
              AllOf(HasSubstr("stars.csv:2"), HasSubstr("more cells")));
  EXPECT_EQ(parsed_stars("ra_deg,dec_deg,v_mag\n1,2,3,,\n").stars.size(), 1U);
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,mag,Mag\n1,2,3,4\n"), HasSubstr("two columns for a magnitude"));
}

TEST(StarTable, ColumnsMayBeNamedInCapitals) {
  const StarCatalogue read = parsed_stars("RA,Dec,Mag,CI\n1,2,3,0.5\n");
  ASSERT_EQ(read.stars.size(), 1U);
  EXPECT_EQ(read.stars[0].ra_deg, 15.0);
  EXPECT_EQ(read.stars[0].b_v, 0.5F);
}

TEST(StarTable, CellsMayBeSeparatedBySemicolonsOrTabs) {
  for (const char* const text :
       {"ra_deg;dec_deg;v_mag;b_v\r\n1;-2,5;3.25;0,5\r\n", "ra_deg\tdec_deg\tv_mag\tb_v\n1\t-2.5\t3.25\t0.5\n",
        "\"ra_deg\";dec_deg;v_mag;b_v\n1;-2.5;\"3.25\";0.5\n"}) {
    const StarCatalogue read = parsed_stars(text);
    ASSERT_EQ(read.stars.size(), 1U) << text;
    EXPECT_EQ(read.stars[0].ra_deg, 1.0);
    EXPECT_EQ(read.stars[0].dec_deg, -2.5);
    EXPECT_EQ(read.stars[0].v_mag, 3.25F);
    EXPECT_EQ(read.stars[0].b_v, 0.5F);
  }
}

TEST(StarTable, WordsForUnknownNumbersAreBlank) {
  const StarCatalogue read = parsed_stars("ra_deg,dec_deg,v_mag,b_v\n1,2,3,null\n1,2,null,0.5\n1,2,3,--\n");
  ASSERT_EQ(read.stars.size(), 2U);
  EXPECT_TRUE(std::isnan(read.stars[0].b_v) && std::isnan(read.stars[1].b_v));
}

TEST(StarTable, ColourThatNoStarHasIsNotKnown) {
  const StarCatalogue read = parsed_stars("ra_deg,dec_deg,v_mag,b_v\n1,2,3,99\n1,2,4,-99\n");
  ASSERT_EQ(read.stars.size(), 2U);
  EXPECT_TRUE(std::isnan(read.stars[0].b_v) && std::isnan(read.stars[1].b_v));
}

TEST(StarTable, PlaceOffTheSphereIsAnError) {
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,v_mag\n1,91,3\n"), HasSubstr("declination of 91"));
}

TEST(StarTable, MagnitudeOfNoStarIsAnError) {
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,v_mag\n1,1,-300\n"), HasSubstr("magnitude of -300"));
}

TEST(StarTable, UnclosedQuoteDoesNotSwallowTheFile) {
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,v_mag\n1,2,\"" + std::string(400'000, 'x')), HasSubstr("64 KiB"));
}

TEST(StarTable, AQuoteThatIsOpenAtTheEndIsAnErrorWithItsLine) {
  EXPECT_THAT(catalogue_problem("ra_deg,dec_deg,v_mag,name\n1,2,3,Mira\n1,2,3,\"Sirius\n4,5,6,Vega\n"),
              HasSubstr("stars.csv:3: has a quotation mark that is never closed"));
}

class StarFile : public test::FolderTest {
 protected:
  std::filesystem::path written() {
    auto path = folder_ / "some.stars";
    write_star_file(
        parsed_stars(
            "hip,ra_deg,dec_deg,v_mag,b_v\n1,0,90,1.001,0.5\n2,359.9999999,-90,-1.4,\n3,10.1234567,5,8,-0.4\n"),
        path);
    return path;
  }

  static Bytes bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto raw = std::as_bytes(std::span(text));
    return {raw.begin(), raw.end()};
  }
};

TEST_F(StarFile, GivesBackWhatWasWritten) {
  const StarCatalogue read = read_stars(written());
  ASSERT_EQ(read.stars.size(), 3U);
  EXPECT_EQ(read.name, "some");
  EXPECT_EQ(read.stars[0].number, 2U);
  EXPECT_NEAR(read.stars[0].ra_deg, 359.9999999, 1e-9);
  EXPECT_TRUE(std::isnan(read.stars[0].b_v));
  EXPECT_NEAR(read.stars[1].v_mag, 1.001F, 1e-6F);
  EXPECT_NEAR(read.stars[2].ra_deg, 10.1234567, 1e-9);
}

TEST_F(StarFile, EveryFlippedByteIsNoticed) {
  const Bytes good = bytes_of(written());
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= std::byte{0x10};
    EXPECT_THROW(parse_star_file(bad, "bad"), Error) << i;
  }
}

TEST_F(StarFile, EveryCutIsNoticed) {
  const Bytes good = bytes_of(written());
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THROW(parse_star_file(std::span(good).first(size), "cut"), Error) << size;
  }
}

}  // namespace
}  // namespace ergodome
