#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "content/stars/sky_angle.h"
#include "content/stars/star_colour.h"
#include "content/stars/star_table.h"
#include "kernels/sky/blackbody.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

StarCatalogue foreign_stars(const std::string& name) {
  return read_stars(std::filesystem::path(ERGODOME_TEST_DATA_DIR) / "foreign" / "stars" / name);
}

StarCatalogue stars_of_text(const std::string& text) {
  std::istringstream stream(text);
  return parse_star_table(stream, "stars.csv");
}

std::string problem_of_stars(const std::string& text) {
  return test::error_of([&] { stars_of_text(text); });
}

//! Compresses a text with gzip.
std::string gzipped(const std::string& text) {
  z_stream state{};
  EXPECT_EQ(deflateInit2(&state, Z_BEST_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&state, text.size()) + 64, '\0');
  std::string from = text;
  state.next_in = reinterpret_cast<Bytef*>(from.data());
  state.avail_in = static_cast<uInt>(from.size());
  state.next_out = reinterpret_cast<Bytef*>(packed.data());
  state.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&state, Z_FINISH), Z_STREAM_END);
  packed.resize(state.total_out);
  deflateEnd(&state);
  return packed;
}

void expect_star(const CatalogueStar& star, double ra_deg, double dec_deg, double v_mag, double b_v) {
  EXPECT_NEAR(star.ra_deg, ra_deg, 2e-4);
  EXPECT_NEAR(star.dec_deg, dec_deg, 2e-4);
  EXPECT_NEAR(star.v_mag, v_mag, 1e-5);
  if (std::isnan(b_v)) {
    EXPECT_TRUE(std::isnan(star.b_v));
  } else {
    EXPECT_NEAR(star.b_v, b_v, 1e-5);
  }
}

// Position (J2000), V magnitude and B-V of Sirius in the Hipparcos Catalogue (ESA 1997).
void expect_sirius(const CatalogueStar& star) { expect_star(star, 101.2872, -16.7161, -1.44, 0.009); }

TEST(ForeignStars, HipparcosFromVizierHasItsPublishedValues) {
  const StarCatalogue read = foreign_stars("vizier_hipparcos.tsv");
  ASSERT_EQ(read.stars.size(), 4U);
  expect_sirius(read.stars[0]);
  expect_star(read.stars[1], 279.2347, 38.7837, 0.03, -0.001);  // Vega
  expect_star(read.stars[2], 88.7929, 7.4071, 0.45, 1.500);     // Betelgeuse
  expect_star(read.stars[3], 37.9546, 89.2641, 1.97, 0.636);    // Polaris
  EXPECT_EQ(read.stars[3].number, 11767U);
  EXPECT_EQ(read.read_as, "_RAJ2000 in degrees, _DEJ2000; V from Vmag; color from B-V");
}

TEST(ForeignStars, SexagesimalCoordinatesFromVizierAndStellarium) {
  const StarCatalogue bars = foreign_stars("vizier_bars.tsv");
  ASSERT_EQ(bars.stars.size(), 2U);
  expect_star(bars.stars[0], 78.6345, -8.2016, 0.18, -0.03);  // Rigel
  EXPECT_DOUBLE_EQ(bars.stars[1].dec_deg, -0.5);
  const StarCatalogue stellarium = foreign_stars("stellarium.csv");
  ASSERT_EQ(stellarium.stars.size(), 2U);
  EXPECT_NEAR(stellarium.stars[0].ra_deg, 78.6346, 1e-4);
  EXPECT_NEAR(stellarium.stars[0].dec_deg, -8.2017, 1e-4);
  EXPECT_NEAR(stellarium.stars[1].dec_deg, 89.2641, 1e-4);
}

TEST(ForeignStars, GaiaIsInDegreesEvenBelow24AndHasVAndColourOfItsOwnBands) {
  for (const char* const name : {"gaia_archive.csv", "vizier_gaia.tsv"}) {
    const StarCatalogue read = foreign_stars(name);
    ASSERT_FALSE(read.stars.empty()) << name;
    // A star with the Sun's colors: BP-RP of 0.823 corresponds to B-V of 0.650 (Mamajek) and to G-V
    // of -0.15340 (Riello et al. 2021).
    expect_star(read.stars[0], 10.6847, 41.2688, 10.15340, 0.650);
    EXPECT_THAT(read.read_as, HasSubstr(" in degrees")) << name;
  }
  const StarCatalogue archive = foreign_stars("gaia_archive.csv");
  ASSERT_EQ(archive.stars.size(), 3U);
  EXPECT_THAT(archive.read_as, HasSubstr("ra in degrees (columns named as in Gaia's archive)"));
  EXPECT_NEAR(archive.stars[1].b_v, 0.650, 2e-4) << "from its temperature of 5778 K";
  EXPECT_TRUE(std::isnan(archive.stars[2].b_v));
}

TEST(ForeignStars, TychoMagnitudesBecomeJohnson) {
  const StarCatalogue read = foreign_stars("vizier_tycho.csv");
  ASSERT_EQ(read.stars.size(), 2U);
  // Tycho magnitudes with BT - VT = 1.818 are converted by V = VT - 0.090 (BT - VT) and B-V = 0.850
  // (BT - VT) (ESA SP-1200).
  expect_star(read.stars[0], 1.1256, 2.2674, 8.50638, 1.5453);
}

TEST(ForeignStars, TablesOfTopcatAstropyAndSpreadsheets) {
  for (const char* const name : {"topcat_ascii.txt", "excel_german.csv", "excel_unicode.txt", "utf16_big.csv"}) {
    const StarCatalogue read = foreign_stars(name);
    ASSERT_FALSE(read.stars.empty()) << name;
    EXPECT_NEAR(read.stars[0].ra_deg, 101.2872, 2e-4) << name;
    EXPECT_NEAR(read.stars[0].dec_deg, -16.7161, 1e-4) << name;
    EXPECT_NEAR(read.stars[0].v_mag, -1.44, 1e-6) << name;
    EXPECT_TRUE(read.left_out.empty()) << name;
  }
  const StarCatalogue ecsv = foreign_stars("astropy.ecsv");
  ASSERT_EQ(ecsv.stars.size(), 2U);
  expect_star(ecsv.stars[0], 101.2872, -16.7161, -1.46, 0.0);
  expect_star(ecsv.stars[1], 10.8974, -17.9866, 2.01, std::nan(""));
}

TEST(ForeignStars, PackedHygOfTwoMembersIsReadAndNamedWithoutItsEndings) {
  const StarCatalogue read = foreign_stars("hyg_v42.csv.gz");
  ASSERT_EQ(read.stars.size(), 1U);
  expect_sirius(read.stars[0]);
  EXPECT_EQ(read.name, "hyg_v42");
  EXPECT_EQ(text_of(read.left_out), "1 row skipped: 1 row for the Sun (line 2)");
  EXPECT_THAT(read.read_as, HasSubstr("ra in hours (columns named as in HYG)"));
}

TEST(ForeignStars, UnitOfAColumnRaIsDecidedByEvidence) {
  const auto first = [](const std::string& text) { return stars_of_text(text).stars.at(0).ra_deg; };
  EXPECT_EQ(first("ra,dec,mag\n2,3,4\n"), 30.0);
  EXPECT_THAT(stars_of_text("ra,dec,mag\n2,3,4\n").read_as, HasSubstr("ra in hours (assumed"));
  EXPECT_EQ(first("ra,dec,mag\n2,3,4\n200,3,5\n"), 2.0);
  EXPECT_EQ(first("ra,dec,mag,ci\n2,3,4,0\n"), 30.0);
  EXPECT_EQ(first("ra,dec,mag,ci\n2,3,4,0\n200,3,5,0\n"), 2.0);
  EXPECT_EQ(first("ra,dec,mag,bp_rp\n2,3,4,0\n"), 2.0);
  EXPECT_EQ(first("ra\tdec\tmag\ndeg\tdeg\tmag\n2\t3\t4\n"), 2.0);
  EXPECT_EQ(first("ra\tdec\tmag\nh\tdeg\tmag\n2\t3\t4\n"), 30.0);
  EXPECT_EQ(first("RA (deg),dec,mag\n2,3,4\n"), 2.0);
  EXPECT_EQ(first("ra[h],dec,mag\n2,3,4\n"), 30.0);
  EXPECT_EQ(first("RA (hh:mm:ss),Dec (dd:mm:ss),mag\n2:30,-3:00,4\n"), 37.5);
  EXPECT_EQ(first("RAJ2000,DEJ2000,Vmag\n2,3,4\n"), 2.0);
  EXPECT_NEAR(first("ra\tdec\tmag\nrad\trad\tmag\n1.5\t0.5\t4\n"), 85.9437, 1e-4);
  EXPECT_THAT(problem_of_stars("ra_hours,dec,mag\n101,3,4\n"),
              HasSubstr("stars.csv:2: has a right ascension of 101 h"));
}

TEST(ForeignStars, WhatIsNotSupportedIsNamed) {
  EXPECT_THAT(problem_of_stars("<?xml version=\"1.0\"?>\n<VOTABLE version=\"1.4\">"), HasSubstr("is a VOTable"));
  EXPECT_THAT(problem_of_stars("SIMPLE  =                    T"), HasSubstr("is a FITS file"));
  EXPECT_THAT(problem_of_stars("PK\x03\x04zip"), HasSubstr("spreadsheet"));
  EXPECT_THAT(problem_of_stars("BZh91AY"), HasSubstr("bzip2"));
  EXPECT_THAT(problem_of_stars("  32349 101.28 -16.71 -1.44\n"), HasSubstr("fixed-width"));
  EXPECT_THAT(problem_of_stars("glon,glat,mag\n1,2,3\n"), HasSubstr("it has galactic coordinates"));
  EXPECT_THAT(problem_of_stars("RAB1950,DEB1950,Vmag\n1,2,3\n"), HasSubstr("equinox B1950"));
  EXPECT_THAT(problem_of_stars("ra,dec,absmag\n1,2,3\n"), HasSubstr("it has absolute magnitudes"));
  EXPECT_THAT(problem_of_stars("ra,dec,gmag\n1,2,3\n"), HasSubstr("Sloan"));
  EXPECT_THAT(problem_of_stars("RAh,RAm,RAs,DEd,Vmag\n1,2,3,4,5\n"), HasSubstr("in several columns"));
  EXPECT_THAT(problem_of_stars("ra\tdec\tmag\ndeg\tdeg\tmmag\n1\t2\t3\n"),
              HasSubstr("gives a magnitude in the unsupported unit \"mmag\""));
  EXPECT_THAT(problem_of_stars("ra dec mag name\n1 2 3 a b\n"), HasSubstr("separated by spaces"));
  EXPECT_THAT(problem_of_stars("ra dec mag name\n1 2 3\n"), HasSubstr("has 3 cells"));
  EXPECT_THAT(problem_of_stars("ra,dec,mag\n05 14 32,2,3\n6.5,2,3\n"), HasSubstr("mixes decimal and sexagesimal"));
  EXPECT_THAT(problem_of_stars("ra_deg,dec,mag\n05 14 32,2,3\n"), HasSubstr("in a column of degrees"));
  EXPECT_THAT(problem_of_stars("RA (deg),dec,mag\n05 14 32,2,3\n"), HasSubstr("in a column of degrees"));
  EXPECT_THAT(problem_of_stars("RA (B1950),dec,mag\n5,2,3\n"),
              HasSubstr("gives a right ascension in the unsupported unit or equinox \"B1950\""));
  EXPECT_THAT(problem_of_stars("#R\nRAJ2000\tDEJ2000\tVmag\n1\t2\t3\n\n#R\nRAJ2000\tDEJ2000\tVmag\n1\t2\t3\n"),
              HasSubstr("stars.csv:6: repeats the column names"));
}

TEST(ForeignStars, CommentsBetweenRowsAreCountedAsLines) {
  const std::string text = "# it's \"odd\nra_deg,dec_deg,mag\n1,2,3\n#\" more\n4,5,six\n";
  EXPECT_THAT(problem_of_stars(text), HasSubstr("stars.csv:5: has \"six\""));
  EXPECT_EQ(stars_of_text("# ra_deg,dec_deg,mag\n1,2,3\n").stars.size(), 1U);
}

TEST(ForeignStars, DamagedGzipIsAnError) {
  const std::string good = gzipped("ra_deg,dec_deg,mag\n1,2,3\n4,5,6\n");
  EXPECT_EQ(stars_of_text(good).stars.size(), 2U);
  EXPECT_EQ(stars_of_text(good + std::string(512, '\0')).stars.size(), 2U);
  for (std::size_t size = 3; size < good.size(); ++size) {
    EXPECT_THAT(problem_of_stars(good.substr(0, size)), HasSubstr("is truncated")) << size;
  }
  EXPECT_THAT(problem_of_stars(good + "rest"), HasSubstr("is damaged"));
  EXPECT_THAT(problem_of_stars(gzipped(good)), HasSubstr("gzip in gzip"));
}

TEST(ForeignStars, GzipThatUnpacksToTooMuchIsAnError) {
  const std::string bomb = gzipped("ra_deg,dec_deg,mag\n#" + std::string(100U << 20U, 'a'));
  EXPECT_THAT(problem_of_stars(bomb), HasSubstr("more than 200 times its size"));
}

TEST(ForeignStars, Utf16ThatIsCutOffIsAnError) {
  const std::string wide("\xFF\xFEr\0a\0,\0", 8);
  EXPECT_THAT(problem_of_stars(wide + "x"), HasSubstr("truncated within a character"));
  EXPECT_THAT(problem_of_stars(std::string("\xFF\xFE\0\0r\0\0\0", 8)), HasSubstr("UTF-32"));
}

double angle_of(const char* text) {
  const auto angle = parse_sky_angle(text);
  return angle ? angle->value : std::nan("");
}

TEST(SkyAngle, ReadsTheUsualForms) {
  const double rigel_h = 5.0 + 14.0 / 60.0 + 32.27 / 3600.0;
  for (const char* const text :
       {"05 14 32.27", "05:14:32.27", "5h14m32.27s", "5h 14m 32.27s", " 05  14 32.27 ", "5\u02B014\u1D5032.27\u02E2"}) {
    EXPECT_NEAR(angle_of(text), rigel_h, 1e-12) << text;
  }
  const double polaris_deg = 89.0 + 15.0 / 60.0 + 51.0 / 3600.0;
  for (const char* const text :
       {"+89\u00B015\u203251\u2033", "89d15m51s", "+89 15 51", "89\u00B0 15' 51\"", "89\26015'51\'\'"}) {
    EXPECT_NEAR(angle_of(text), polaris_deg, 1e-12) << text;
  }
  EXPECT_DOUBLE_EQ(angle_of("-00 30 00"), -0.5);
  EXPECT_DOUBLE_EQ(angle_of("\u22120:30"), -0.5);
  EXPECT_DOUBLE_EQ(angle_of("-08 30.6"), -8.51);
  EXPECT_DOUBLE_EQ(angle_of("-1.5e1"), -15.0);
  EXPECT_EQ(parse_sky_angle("78.6\u00B0")->mark, AngleMark::degrees);
  EXPECT_EQ(parse_sky_angle("5h14m")->mark, AngleMark::hours);
}

TEST(SkyAngle, RefusesOtherText) {
  for (const char* const text : {"", "-", "+-5", "--5", "05:14:", "5 60 0", "5 14 61", "5.5 14 0", "5 14 3 2", "05h14x",
                                 "1,5", "five", "5 -14 0", "14m32s", ":"}) {
    EXPECT_FALSE(parse_sky_angle(text)) << text;
  }
}

TEST(StarColour, TemperatureIsTheInverseOfTheColourWithWhichStarsAreDrawn) {
  // By Ballesteros (2012), the Sun's B-V of 0.65 corresponds to 5778 K.
  EXPECT_NEAR(b_v_from_temperature(5778.0), 0.65, 2e-4);
  for (const double b_v : {-0.4, 0.0, 0.5, 1.5, 5.0}) {
    EXPECT_NEAR(b_v_from_temperature(star_temperature(b_v)), b_v, 1e-12);
  }
  EXPECT_TRUE(std::isnan(b_v_from_temperature(0.0)));
  EXPECT_TRUE(std::isnan(b_v_from_temperature(std::nan(""))));
}

TEST(StarColour, BpRpOfDwarfsIsTheirBV) {
  // Values from Mamajek's table for the types B9.5V, F6V, K4V and M4V, which are not among the
  // nodes of our table.
  EXPECT_NEAR(b_v_from_bp_rp(-0.087), -0.050, 0.01);
  EXPECT_NEAR(b_v_from_bp_rp(0.640), 0.486, 0.01);
  EXPECT_NEAR(b_v_from_bp_rp(1.34), 1.090, 0.01);
  EXPECT_NEAR(b_v_from_bp_rp(2.94), 1.65, 0.1);
  EXPECT_EQ(b_v_from_bp_rp(-5.0), -0.4);
  EXPECT_EQ(b_v_from_bp_rp(9.0), 2.15);
  EXPECT_TRUE(std::isnan(b_v_from_bp_rp(std::nan(""))));
}

TEST(StarColour, GaiaMagnitudesOfDwarfsAreTheirV) {
  // G-V in Mamajek's table: -0.155 for type G2V, -0.925 for type M2V.
  EXPECT_NEAR(v_from_gaia(10.0, 0.823), 10.155, 0.02);
  EXPECT_NEAR(v_from_gaia(10.0, 2.23), 10.925, 0.05);
  EXPECT_EQ(v_from_gaia(10.0, std::nan("")), 10.0);
}

}  // namespace
}  // namespace ergodome
