#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "content/show/reading/show_reader.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

Show show_with_shells(const std::string& shells, const std::string& spin = "0") {
  return parse_show("[hole]\nspin = " + spin + "\n[camera]\n[[camera.key]]\nr = 30\n" + shells, "show.toml");
}

TEST(ShellReader, AShowWithoutAnyHasNone) { EXPECT_TRUE(show_with_shells("").shells.empty()); }

TEST(ShellReader, AShellNeedsItsRadiusAlone) {
  const Show show = show_with_shells("[[shells]]\nradius = 12\n[[shells]]\nradius = 6\ntexture = \"earth.jpg\"\n");
  ASSERT_EQ(show.shells.size(), 2U);
  ShellSettings plain;
  plain.radius = 12.0;
  EXPECT_EQ(show.shells[0], plain);
  // A shell with a texture is opaque unless the show says otherwise.
  EXPECT_EQ(show.shells[1].texture, "earth.jpg");
  EXPECT_EQ(show.shells[1].fill_opacity, 1.0);
}

TEST(ShellReader, WrittenAsTextReadsBackTheSame) {
  Show show = show_with_shells("[[shells]]\nradius = 12\n");
  show.shells.push_back({7.5, 10.0, 0.25, {1.0, 0.5, 0.0}, {0.0, 0.25, 2.0}, 0.75, 0.5, 3.0, "mars.png"});
  EXPECT_EQ(parse_show(to_toml(show), "again.toml").shells, show.shells);
}

TEST(ShellReader, RefusesWhatCannotBe) {
  for (const char* shell :
       {"", "radius = 2", "radius = 1.5", "radius = 2.001", "radius = nan", "radius = -3", "radius = \"isco\"",
        "radius = 9\nspacing_deg = 7", "radius = 9\nspacing_deg = 0", "radius = 9\nline_width_deg = -1",
        "radius = 9\nline_color = [1, 2]", "radius = 9\nfill_color = [1, 2, nan]", "radius = 9\nline_opacity = 2",
        "radius = 9\nfill_opacity = -0.1", "radius = 9\nexposure = inf", "radius = 9\ncolour = 1",
        "radius = 9\ntexture = 3"}) {
    SCOPED_TRACE(shell);
    try {
      show_with_shells("[[shells]]\nradius = 9\n[[shells]]\n" + std::string(shell));
      ADD_FAILURE() << "was taken";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("show.toml:"));
      EXPECT_THAT(error.what(), testing::HasSubstr("shells[1]"));
    }
  }
}

TEST(ShellReader, TakesTheSpacingThatItAdvises) {
  const std::string problem = test::error_of([] { show_with_shells("[[shells]]\nradius = 9\nspacing_deg = 7\n"); });
  EXPECT_THAT(problem, testing::HasSubstr("choose for example 6.92308"));
  const Show show = show_with_shells("[[shells]]\nradius = 9\nspacing_deg = 6.92308\n");
  EXPECT_EQ(show.shells[0].spacing_deg, 180.0 / 26.0);
}

TEST(ShellReader, TakesSixteenShellsAndNoMore) {
  std::string shells;
  for (int i = 0; i < 16; ++i) {
    shells += "[[shells]]\nradius = 9\n";
  }
  EXPECT_EQ(show_with_shells(shells).shells.size(), 16U);
  try {
    show_with_shells(shells + "[[shells]]\nradius = 9\n");
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("at most 16"));
  }
}

TEST(ShellReader, TakesAShellAsNearToTheHorizonAsPicturesAreExact) {
  EXPECT_EQ(show_with_shells("[[shells]]\nradius = 2.002\n").shells[0].radius, 2.002);
  EXPECT_EQ(show_with_shells("[[shells]]\nradius = 1.01\n", "-1").shells[0].radius, 1.01);
}

TEST(ShellReader, HoldsRadiiToTheHorizonOfAllTimes) {
  const std::string radius =
      "[[animate]]\nnumber = \"shells[0].radius\"\nkey = [{ t_s = 0, value = 9 }, { t_s = 5, value = 1.5 }]\n";
  EXPECT_THROW(show_with_shells("[[shells]]\nradius = 9\n" + radius), Error);
  EXPECT_NO_THROW(show_with_shells("[[shells]]\nradius = 9\n" + radius, "0.999"));
  const std::string spin =
      "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = -0.99 }, { t_s = 5, value = 0.99 }]\n";
  EXPECT_THROW(show_with_shells("[[shells]]\nradius = 1.8\n" + spin), Error);
  EXPECT_NO_THROW(show_with_shells("[[shells]]\nradius = 2.1\n" + spin));
}

TEST(ShellReader, RefusesToAnimateAShellThatIsNotThere) {
  const std::string radius =
      "[[animate]]\nnumber = \"shells[1].radius\"\nkey = [{ t_s = 0, value = 9 }, { t_s = 5, value = 8 }]\n";
  EXPECT_THROW(show_with_shells("[[shells]]\nradius = 9\n" + radius), Error);
}

TEST(ShellReader, GoesWithAllStereoModels) {
  const std::string stereo = "[[shells]]\nradius = 9\n[stereo]\nlayout = \"side_by_side\"\nbaseline = 0.1\n";
  EXPECT_TRUE(missing_features(show_with_shells(stereo + "model = \"flat\"")).empty());
  EXPECT_TRUE(missing_features(show_with_shells(stereo + "model = \"omni\"")).empty());
  EXPECT_TRUE(missing_features(show_with_shells(stereo)).empty());
}

}  // namespace
}  // namespace ergodome
