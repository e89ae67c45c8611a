#include "app/player/eye_notice.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

constexpr ReducedBaseline narrow = {StereoModel::omni, 1.5, 0.5, 0.3};

TEST(EyeNotice, TellsOnceOfAShow) {
  EyeNotice notice;
  EXPECT_FALSE(notice.is_news(std::nullopt, std::nullopt));
  EXPECT_TRUE(notice.is_news(narrow, std::nullopt));
  EXPECT_FALSE(notice.is_news(ReducedBaseline{StereoModel::omni, 1.4, 0.6, 0.2}, std::nullopt));
  notice.begin();
  EXPECT_TRUE(notice.is_news(narrow, std::nullopt));
}

TEST(EyeNotice, TellsAgainOfADistanceThatAPersonHasChosen) {
  EyeNotice notice;
  EXPECT_TRUE(notice.is_news(narrow, std::nullopt));
  EXPECT_TRUE(notice.is_news(narrow, 2.0));
  EXPECT_FALSE(notice.is_news(narrow, 2.0));
}

TEST(EyeNotice, SpeaksTheLanguageOfTheShow) {
  EXPECT_EQ(line_of(narrow, "de"),
            "Der Augenabstand von 0.5 M ist hier nicht möglich; er wurde auf den größten möglichen Wert verringert.");
  EXPECT_EQ(line_of(narrow, "en"),
            "The baseline of 0.5 M is not possible here; it was reduced to the largest possible value.");
}

TEST(EyeNotice, NamesTheShowsLineOnlyWhereTheDistanceIsTheShows) {
  Show show;
  show.name = "near";
  show.lines["stereo.baseline"] = 7;
  EXPECT_NE(note_of(show, 2.0, narrow, std::nullopt).find("near.toml:7"), std::string::npos);
  EXPECT_EQ(note_of(show, 2.0, narrow, 0.5).find("near.toml"), std::string::npos);
}

}  // namespace
}  // namespace ergodome
