#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/reading/show_reader.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

Show show_with_disk(const std::string& disk, const std::string& spin = "0") {
  return parse_show("[hole]\nspin = " + spin + "\n[camera]\n[[camera.key]]\nr = 30\n[disk]\n" + disk, "show.toml");
}

TEST(DiskReader, ADiskAloneEndsAtTheLastStableOrbitAndShinesAsPageAndThorneSay) {
  const Show show = show_with_disk("");
  ASSERT_TRUE(show.disk.has_value());
  EXPECT_EQ(*show.disk, DiskSettings{});
  EXPECT_FALSE(show.disk->inner.has_value());
}

TEST(DiskReader, AShowWithoutOneHasNone) {
  EXPECT_FALSE(parse_show("[camera]\n[[camera.key]]\nr = 30\n", "show.toml").disk.has_value());
}

TEST(DiskReader, WrittenAsTextReadsBackTheSame) {
  Show show = show_with_disk("");
  EXPECT_EQ(*parse_show(to_toml(show), "again.toml").disk, *show.disk);
  show.disk =
      DiskSettings{4.5, 30.0, true, DiskProfile::uniform, 9000.0, true, 0.5, 2.5, DiskPattern::procedural, 1.5, -3.0};
  EXPECT_EQ(*parse_show(to_toml(show), "again.toml").disk, *show.disk);
}

TEST(DiskReader, RefusesWhatCannotBe) {
  for (const char* disk :
       {"inner = \"isko\"", "inner = 5", "inner = 0", "outer = 5", "inner = 30", "opacity = 2", "temperature_K = 10",
        "profile = \"novikov\"", "pattern = \"spiral\"", "plunging = true", "plunging = true\nprofile = \"uniform\"",
        "inner = 1.5\nplunging = true\nprofile = \"uniform\"", "speed = nan", "colour = 1", "exposure = -1"}) {
    SCOPED_TRACE(disk);
    try {
      show_with_disk(disk);
      ADD_FAILURE() << "was taken";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("show.toml:"));
      EXPECT_THAT(error.what(), testing::HasSubstr("disk"));
    }
  }
}

TEST(DiskReader, TakesTheInnerEdgeThatItAdvises) {
  for (const char* spin : {"0.9", "-0.5", "0.998", "0.3", "0"}) {
    const std::string problem = test::error_of([&] { show_with_disk("inner = 1", spin); });
    const std::size_t at = problem.find("choose ");
    ASSERT_NE(at, std::string::npos) << problem;
    const std::string advised = problem.substr(at + 7, problem.find(' ', at + 7) - at - 7);
    EXPECT_NO_THROW(show_with_disk("inner = " + advised, spin)) << "spin " << spin << ", inner " << advised;
  }
}

TEST(DiskReader, TakesMatterThatFallsInsideTheLastStableOrbit) {
  EXPECT_EQ(show_with_disk("inner = 2.5\nplunging = true\nprofile = \"uniform\"").disk->inner, 2.5);
}

TEST(DiskReader, TakesAnInnerEdgeThatHoldsAtSomeTimeOfASpinThatChanges) {
  const std::string spin =
      "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = 0 }, { t_s = 5, value = 0.9 }]\n";
  const std::string camera = "[camera]\n[[camera.key]]\nr = 30\n";
  EXPECT_EQ(parse_show(camera + "[disk]\ninner = 3\n" + spin, "show.toml").disk->inner, 3.0);
  EXPECT_THROW(parse_show(camera + "[disk]\ninner = 2\n" + spin, "show.toml"), Error);
}

TEST(DiskReader, GoesWithAllStereoModels) {
  const auto with = [](const std::string& model) {
    return show_with_disk("[stereo]\nlayout = \"side_by_side\"\nbaseline = 0.1\nmodel = \"" + model + "\"");
  };
  EXPECT_TRUE(missing_features(with("flat")).empty());
  EXPECT_TRUE(missing_features(with("omni")).empty());
  EXPECT_TRUE(missing_features(with("physical")).empty());
}

}  // namespace
}  // namespace ergodome
