#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

//! The text of a show with three lines; lines that a test appends start with the fourth.
const std::string smallest_show = "[camera]\n[[camera.key]]\nr = 10\n";

std::string timeline_problem(const std::string& lines) {
  return error_of([&] { parse_show(smallest_show + lines, "show.toml"); });
}

Show show_with(const std::string& lines) { return parse_show(smallest_show + lines, "show.toml"); }

constexpr const char* whole_timeline = R"(
[effects]
bloom = {}
[[animate]]
number = "hole.spin"
key = [{ t_s = 0, value = 0.5 }, { t_s = 10, value = 0.9, ease = "in_out" }, { t_s = 12.3, value = 0.1 }]
[[animate]]
number = "effects.bloom.strength"
[[animate.key]]
t_s = 0.1
value = 0.30000000000000004
ease = "hold"
[[chapter]]
t_s = 0
title = "Start"
[[chapter]]
t_s = 5
title = { en = "The shadow", de = "Der Schatten", "pt-BR" = "A sombra" }
[[caption]]
from_s = 1
to_s = 4.5
fade_in_s = 0.25
fade_out_s = 1
azimuth_deg = -30
elevation_deg = 15
roll_deg = 5
letter_deg = 3
width_deg = 40
color = [1, 0.5, 0.25]
text = { en = "Two\nlines", de = "Über uns: 光" }
[[overlay]]
image = "logo.png"
from_s = 2
to_s = 3
fisheye = true
fov_deg = 200
opacity = 0.5
[[audio]]
file = "music/one.flac"
from_s = 0.5
gain_db = -6
fade_in_s = 1
fade_out_s = 2
loop = true
[[audio]]
file = "words.fr.ogg"
language = "fr"
)";

//! Expects the timeline that `whole_timeline` describes.
void expect_whole(const Timeline& timeline) {
  ASSERT_EQ(timeline.animations.size(), 2U);
  EXPECT_EQ(timeline.animations[0].path, "hole.spin");
  ASSERT_EQ(timeline.animations[0].keys.size(), 3U);
  EXPECT_EQ(timeline.animations[0].keys[0].ease, Ease::smooth);
  EXPECT_EQ(timeline.animations[0].keys[1].ease, Ease::in_out);
  EXPECT_EQ(timeline.animations[0].keys[2].time_s, 12.3);
  EXPECT_EQ(timeline.animations[1].keys.at(0).value, 0.30000000000000004);
  EXPECT_EQ(timeline.animations[1].keys.at(0).ease, Ease::hold);
  ASSERT_EQ(timeline.chapters.size(), 2U);
  EXPECT_EQ(timeline.chapters[0].title, (LocalText{{"", "Start"}}));
  EXPECT_EQ(timeline.chapters[1].time_s, 5.0);
  EXPECT_EQ(timeline.chapters[1].title,
            (LocalText{{"en", "The shadow"}, {"de", "Der Schatten"}, {"pt-BR", "A sombra"}}));
  ASSERT_EQ(timeline.captions.size(), 1U);
  const Caption& caption = timeline.captions[0];
  EXPECT_EQ(caption.presence.from_s, 1.0);
  EXPECT_EQ(caption.presence.to_s, 4.5);
  EXPECT_EQ(caption.presence.fade_in_s, 0.25);
  EXPECT_EQ(caption.presence.fade_out_s, 1.0);
  EXPECT_EQ(caption.position.azimuth_deg, -30.0);
  EXPECT_EQ(caption.position.elevation_deg, 15.0);
  EXPECT_EQ(caption.position.roll_deg, 5.0);
  EXPECT_EQ(caption.letter_deg, 3.0);
  EXPECT_EQ(caption.width_deg, 40.0);
  EXPECT_EQ(caption.color, (std::array<double, 3>{1.0, 0.5, 0.25}));
  EXPECT_EQ(caption.text, (LocalText{{"en", "Two\nlines"}, {"de", "Über uns: 光"}}));
  ASSERT_EQ(timeline.overlays.size(), 1U);
  EXPECT_EQ(timeline.overlays[0].image, "logo.png");
  EXPECT_TRUE(timeline.overlays[0].fisheye);
  EXPECT_EQ(timeline.overlays[0].fov_deg, 200.0);
  EXPECT_EQ(timeline.overlays[0].opacity, 0.5);
  EXPECT_EQ(timeline.overlays[0].presence.fade_in_s, 0.5);
  ASSERT_EQ(timeline.audio.size(), 2U);
  EXPECT_EQ(timeline.audio[0].file, "music/one.flac");
  EXPECT_EQ(timeline.audio[0].gain_db, -6.0);
  EXPECT_EQ(timeline.audio[0].fade_out_s, 2.0);
  EXPECT_TRUE(timeline.audio[0].loop);
  EXPECT_EQ(timeline.audio[1].language, "fr");
}

TEST(Timeline, ReadsBackAsItIsWritten) {
  const Show show = show_with(whole_timeline);
  expect_whole(show.timeline);
  EXPECT_EQ(show.lines.at("animate.hole.spin"), 7);
}

TEST(Timeline, WrittenAsTextReadsBackTheSame) {
  const Show show = show_with(whole_timeline);
  expect_whole(parse_show(to_toml(show), "show.toml").timeline);
}

TEST(Timeline, WrittenTwiceIsTheSameText) {
  const std::string text = to_toml(show_with(whole_timeline));
  EXPECT_EQ(to_toml(parse_show(text, "show.toml")), text);
}

TEST(Timeline, CameraKeysKeepTheirHoldAndEase) {
  const Show show =
      parse_show(to_toml(show_with("hold_s = 2.5\nease = \"out\"\n[[camera.key]]\nt_s = 9\nr = 8\n")), "a");
  EXPECT_EQ(show.camera.keys[0].hold_s, 2.5);
  EXPECT_EQ(show.camera.keys[0].ease, Ease::out);
  EXPECT_EQ(show.camera.keys[1].ease, Ease::smooth);
}

TEST(Timeline, RefusesCameraKeysThatCannotBe) {
  EXPECT_THAT(timeline_problem("hold_s = 9\n[[camera.key]]\nt_s = 9\nr = 8\n"),
              AllOf(HasSubstr("show.toml:6"), HasSubstr("hold_s")));
  EXPECT_THAT(timeline_problem("hold_s = -1\n"), HasSubstr("hold_s is -1"));
  EXPECT_THAT(timeline_problem("ease = \"hold\"\n"), HasSubstr("camera.key[0].ease"));
}

TEST(Timeline, KnowsItsLanguages) {
  EXPECT_THAT(languages(show_with(whole_timeline).timeline), ElementsAre("de", "en", "fr", "pt-BR"));
  EXPECT_TRUE(languages(show_with("[[chapter]]\nt_s = 0\ntitle = \"A\"\n").timeline).empty());
}

TEST(Timeline, TextFallsBackToWhatThereIs) {
  const LocalText text = {{"", "plain"}, {"de", "deutsch"}, {"en", "english"}};
  EXPECT_EQ(text_in(text, "de"), "deutsch");
  EXPECT_EQ(text_in(text, "de-AT"), "deutsch");
  EXPECT_EQ(text_in(text, "fr"), "plain");
  EXPECT_EQ(text_in(text, ""), "plain");
  EXPECT_EQ(text_in({{"en", "english"}, {"fr", "français"}}, "de"), "english");
  EXPECT_EQ(text_in({}, "de"), "");
}

TEST(Timeline, RefusesNumbersThatCannotBeAnimated) {
  const auto problem = [](const std::string& path) {
    return timeline_problem("[[animate]]\nnumber = \"" + path + "\"\nkey = [{ t_s = 0, value = 1 }]\n");
  };
  EXPECT_THAT(problem("hole.spinn"), AllOf(HasSubstr("show.toml:5"), HasSubstr("\"hole.spin\"")));
  EXPECT_THAT(problem("view.size_px"),
              AllOf(HasSubstr("show.toml:5"), HasSubstr("cannot be animated"), HasSubstr("the same size")));
  EXPECT_THAT(problem("camera.key"), HasSubstr("write [[camera.key]]"));
  EXPECT_THAT(problem("effects.bloom.strength"), AllOf(HasSubstr("no effects.bloom"), HasSubstr("[effects.bloom]")));
  EXPECT_THAT(problem("shells[1].radius"), HasSubstr("add another [[shells]]"));
  EXPECT_THAT(timeline_problem("[[animate]]\nkey = [{ t_s = 0, value = 1 }]\n"), HasSubstr("number is missing"));
  EXPECT_THAT(timeline_problem("[view]\nprojection = \"cylinder\"\n[[animate]]\nnumber = \"view.fov_deg\"\n"),
              HasSubstr("height"));
}

TEST(Timeline, RefusesTheSameNumberTwice) {
  const std::string once = "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = 0 }]\n";
  EXPECT_THAT(timeline_problem(once + once), AllOf(HasSubstr("show.toml:8"), HasSubstr("animated twice")));
}

//! Returns the error message for animation keys of a number; the keys are in line 6 of the show.
std::string key_problem(const std::string& keys, const std::string& number = "hole.spin") {
  return timeline_problem("[[animate]]\nnumber = \"" + number + "\"\nkey = [" + keys + "]\n");
}

TEST(Timeline, RefusesValuesThatTheNumberItselfCouldNotHave) {
  EXPECT_THAT(
      key_problem("{ t_s = 0, value = 1.5 }"),
      AllOf(HasSubstr("show.toml:6"), HasSubstr("animate[0].key[0].value is 1.5"), HasSubstr("outside -1 to 1")));
  EXPECT_THAT(key_problem("{ t_s = 0, value = nan }"), HasSubstr("value is nan"));
  EXPECT_THAT(key_problem("{ t_s = inf, value = 0 }"), HasSubstr("t_s is inf"));
  EXPECT_THAT(key_problem("{ t_s = 0, value = 1e13 }", "sky.exposure"), HasSubstr("value is"));
  EXPECT_THAT(
      timeline_problem("[view]\nlens = \"orthographic\"\n[[animate]]\nnumber = \"view.fov_deg\"\nkey = [{ t_s = 0, "
                       "value = 200 }]\n"),
      HasSubstr("to 180"));
}

TEST(Timeline, RefusesKeysThatAreNone) {
  EXPECT_THAT(key_problem(""), HasSubstr("key is missing"));
  EXPECT_THAT(key_problem("{ t_s = 0 }"), HasSubstr("value is missing"));
  EXPECT_THAT(key_problem("{ value = 0 }"), HasSubstr("t_s is missing"));
  EXPECT_THAT(key_problem("{ t_s = 1, value = 0 }, { t_s = 1, value = 0 }"), HasSubstr("key[1].t_s is not later than"));
  EXPECT_THAT(key_problem("{ t_s = 1, value = 0, eas = \"in\" }"), HasSubstr("\"ease\""));
  EXPECT_THAT(key_problem("{ t_s = 1, value = 0, ease = \"inout\" }"), HasSubstr("\"in_out\""));
}

TEST(Timeline, RefusesNumbersThatWouldCross) {
  EXPECT_THAT(key_problem("{ t_s = 0, value = 89.5 }", "stereo.fade.from_deg"),
              HasSubstr("keep them at least 1 apart"));
  EXPECT_EQ(key_problem("{ t_s = 0, value = 89 }", "stereo.fade.from_deg"), "");
}

TEST(Timeline, RefusesASpinWhoseHorizonReachesTheCamera) {
  const std::string spin =
      "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = 1 }, { t_s = 10, value = 0.9 }]\n";
  const auto problem = [&](const std::string& r) {
    return error_of([&] { parse_show("[camera]\n[[camera.key]]\nr = " + r + "\n" + spin, "show.toml"); });
  };
  EXPECT_EQ(problem("1.5"), "");
  EXPECT_THAT(problem("1.2"), AllOf(HasSubstr("show.toml:4"), HasSubstr("horizon")));
}

TEST(Timeline, RefusesTimesThatAreOutOfOrder) {
  EXPECT_THAT(timeline_problem("[[chapter]]\nt_s = 5\ntitle = \"a\"\n[[chapter]]\nt_s = 5\ntitle = \"b\"\n"),
              AllOf(HasSubstr("show.toml:8"), HasSubstr("chapter[1].t_s")));
  EXPECT_THAT(timeline_problem("[[caption]]\nfrom_s = 5\nto_s = 5\ntext = \"a\"\n"),
              AllOf(HasSubstr("show.toml:6"), HasSubstr("caption[0].to_s")));
  EXPECT_THAT(timeline_problem("[[caption]]\nfrom_s = 5\ntext = \"a\"\n"), HasSubstr("to_s is missing"));
  EXPECT_THAT(timeline_problem("[[caption]]\nfrom_s = 5\nto_s = 6\nfade_in_s = 0.7\nfade_out_s = 0.7\ntext = \"a\"\n"),
              HasSubstr("fade_out_s and the other fade together take longer"));
}

TEST(Timeline, UsualFadesFitIntoWhatIsThereShortly) {
  const Presence presence =
      show_with("[[caption]]\nfrom_s = 5\nto_s = 5.5\nfade_out_s = 0.4\ntext = \"a\"\n").timeline.captions[0].presence;
  EXPECT_NEAR(presence.fade_in_s, 0.1, 1e-12);
  EXPECT_EQ(presence.fade_out_s, 0.4);
}

TEST(Timeline, RefusesTextThatIsNone) {
  const auto problem = [](const std::string& text) {
    return timeline_problem("[[chapter]]\nt_s = 0\ntitle = " + text + "\n");
  };
  EXPECT_THAT(problem("\"\""), HasSubstr("chapter[0].title is empty"));
  EXPECT_THAT(problem("{}"), HasSubstr("has no language"));
  EXPECT_THAT(problem("3"), HasSubstr("is not a text"));
  EXPECT_THAT(problem("\"bell \\u0007\""), HasSubstr("control character"));
  EXPECT_THAT(problem("{ e = \"a\" }"), HasSubstr("is not a language tag"));
  EXPECT_THAT(problem("{ \"en-\" = \"a\" }"), HasSubstr("is not a language tag"));
  EXPECT_THAT(problem("{ english_words = \"a\" }"), HasSubstr("is not a language tag"));
  EXPECT_THAT(problem("\"\xff\""), HasSubstr("show.toml:6"));
  EXPECT_THAT(timeline_problem("[[chapter]]\nt_s = 0\n"), HasSubstr("title is missing"));
}

TEST(Timeline, RefusesUnknownKeysAndMissingFiles) {
  EXPECT_THAT(timeline_problem("[[caption]]\nfrom_s = 0\nto_s = 1\nazimut_deg = 3\ntext = \"a\"\n"),
              AllOf(HasSubstr("show.toml:7"), HasSubstr("azimuth_deg")));
  EXPECT_THAT(timeline_problem("[[captions]]\n"), HasSubstr("\"caption\""));
  EXPECT_THAT(timeline_problem("[[overlay]]\nfrom_s = 0\nto_s = 1\n"), HasSubstr("overlay[0].image is missing"));
  EXPECT_THAT(timeline_problem("[[audio]]\n"), HasSubstr("audio[0].file is missing"));
  EXPECT_THAT(timeline_problem("[[audio]]\nfile = \"a\"\nlanguage = \"e\"\n"), HasSubstr("audio[0].language"));
  EXPECT_THAT(timeline_problem("[[audio]]\nfile = \"a\"\ngain_db = 30\n"), HasSubstr("gain_db is 30"));
  EXPECT_THAT(timeline_problem("[chapter]\nt_s = 0\n"), HasSubstr("[[chapter]]"));
}

}  // namespace
}  // namespace ergodome
