#include "content/show/show_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "content/stars/star_catalogue.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

class FilesOfAShow : public test::FolderTest {
 protected:
  //! Returns a show with a camera and the given lines, as if it was read from film.toml in the
  //! test's folder.
  [[nodiscard]] Show film(const std::string& text) const {
    return parse_show(text + "[camera]\n[[camera.key]]\nr = 30\n", (folder_ / "film.toml").string());
  }
};

TEST_F(FilesOfAShow, AMissingSkyIsToldWithTheLineThatNamesIt) {
  const Show show = film("[hole]\nspin = 0.5\n[sky]\nmap = \"none.jpg\"\n");
  EXPECT_THAT(test::error_of([&] { load_sky_map(show); }),
              AllOf(HasSubstr("none.jpg: does not exist"), HasSubstr("(sky.map, film.toml:4)")));
}

TEST_F(FilesOfAShow, ASkyThatIsNoImageIsToldWithTheLineThatNamesIt) {
  std::ofstream(folder_ / "words.png") << "words";
  const Show show = film("[sky]\nmap = \"words.png\"\n");
  EXPECT_THAT(test::error_of([&] { load_sky_map(show); }),
              AllOf(HasSubstr("words.png"), HasSubstr("(sky.map, film.toml:2)")));
}

TEST_F(FilesOfAShow, AStarTableKeepsItsOwnPlaceBesideTheLineThatNamesIt) {
  std::ofstream(folder_ / "mine.csv") << "ra_deg,dec_deg,v_mag\n1,2,bright\n";
  const Show show = film("[sky]\nmap = \"grid\"\nstars = \"mine.csv\"\n");
  EXPECT_THAT(test::error_of([&] { load_stars(show); }),
              AllOf(HasSubstr("mine.csv:2"), HasSubstr("(sky.stars, film.toml:3)")));
}

TEST_F(FilesOfAShow, OfSeveralShellsAndObjectsEachHasItsLine) {
  const Show show = film(
      "[[shells]]\nradius = 4\n[[shells]]\nradius = 6\ntexture = \"earth.jpg\"\n"
      "[[objects]]\nmesh = \"ship.obj\"\nposition = [-8, 0, 0]\n");
  EXPECT_EQ(named_by(show, "shells[1].texture", Error("a", "b")).problem(), "b (shells[1].texture, film.toml:5)");
  EXPECT_EQ(named_by(show, "objects[0].mesh", Error("a", "b")).problem(), "b (objects[0].mesh, film.toml:7)");
}

TEST_F(FilesOfAShow, WhatNoFileSaidIsToldByItsKeyAlone) {
  EXPECT_EQ(named_by(Show{}, "sky.map", Error("a", "b", "c")).problem(), "b (sky.map)");
  EXPECT_EQ(named_by(Show{}, "sky.map", Error("a", "b", "c")).remedy(), "c");
}

}  // namespace
}  // namespace ergodome
