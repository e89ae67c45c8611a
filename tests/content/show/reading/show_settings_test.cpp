#include "content/show/reading/show_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "content/show/show_errors.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* set_show = R"(title = "Evening"
duration_s = 10
[hole]
spin = 0.9
[camera]
observer = { beta = 0.4, toward = [0, 0, 1] }
[[camera.key]]
t_s = 0
r = 14
[[camera.key]]
t_s = 10
r = 8
[sky]
map = "dust.exr"
)";

Show show_set(const ShowSettings& settings) { return parse_show(set_show, "evening.toml", settings); }

std::string setting_problem(const ShowSettings& settings) {
  return test::error_of([&] { show_set(settings); });
}

TEST(ShowSettings, ChangeWhatTheFileSays) {
  const Show show =
      show_set({"hole.spin=0.5", "camera.key.0.r=30", "camera.key[1].theta_deg=45", "camera.observer.toward.2=-1"});
  EXPECT_EQ(show.spin, 0.5);
  EXPECT_EQ(show.camera.keys.at(0).r, 30.0);
  EXPECT_EQ(show.camera.keys.at(1).r, 8.0);
  EXPECT_NEAR(show.camera.keys.at(1).theta, 0.7853981633974483, 1e-15);
  EXPECT_EQ(show.camera.velocity.z, -0.4);
}

TEST(ShowSettings, AreReadAsTheSameLinesOfAFile) {
  const std::string lines = "[effects]\nredshift = true\npsf = { sigma_px = 0.7 }\n[tone]\ncurve = \"filmic\"\n";
  EXPECT_EQ(to_toml(show_set({"effects.redshift=true", "effects.psf.sigma_px=0.7", "tone.curve=filmic"})),
            to_toml(parse_show(set_show + lines, "evening.toml")));
}

TEST(ShowSettings, ReplaceAnimations) {
  const std::string text = std::string(set_show) + R"(
[[shells]]
radius = 30
[[animate]]
number = "hole.spin"
key = [{ t_s = 0, value = 0.1 }, { t_s = 10, value = 0.8 }]
[[animate]]
number = "view.fov_deg"
key = [{ t_s = 0, value = 90 }, { t_s = 10, value = 180 }]
[[animate]]
number = "shells[0].radius"
key = [{ t_s = 0, value = 30 }, { t_s = 10, value = 40 }]
)";
  const auto animated = [&](const ShowSettings& settings) {
    std::vector<std::string> paths;
    for (const Animation& each : parse_show(text, "evening.toml", settings).timeline.animations) {
      paths.push_back(each.path);
    }
    return paths;
  };
  using testing::ElementsAre;
  EXPECT_THAT(animated({"hole.spin=0.5"}), ElementsAre("view.fov_deg", "shells[0].radius"));
  EXPECT_THAT(animated({"shells.0.radius=35"}), ElementsAre("hole.spin", "view.fov_deg"));
  EXPECT_THAT(animated({"hole={spin=0.5}"}), ElementsAre("view.fov_deg", "shells[0].radius"));
  EXPECT_THAT(animated({"shells=[]"}), ElementsAre("hole.spin", "view.fov_deg"));
  EXPECT_THAT(animated({"view.tilt_deg=10"}), ElementsAre("hole.spin", "view.fov_deg", "shells[0].radius"));
  // Settings count animations as in the file, whatever other settings remove.
  const Show show = parse_show(text, "evening.toml", {"hole.spin=0.5", "animate.1.key.0.value=120"});
  EXPECT_EQ(show_at(show, 0.0).spin, 0.5);
  EXPECT_EQ(show_at(show, 5.0).spin, 0.5);
  EXPECT_EQ(show_at(show, 0.0).view.field_of_view_deg, 120.0);
}

TEST(ShowSettings, HaveTheTypesOfToml) {
  EXPECT_EQ(text_in(show_set({"title=A title"}).title, ""), "A title");
  EXPECT_EQ(text_in(show_set({"title=\"A title\""}).title, ""), "A title");
  EXPECT_EQ(text_in(show_set({"title=C:\\new \"one\""}).title, ""), "C:\\new \"one\"");
  EXPECT_EQ(text_in(show_set({"title=a=b # c"}).title, ""), "a=b # c");
  EXPECT_EQ(text_in(show_set({R"(title={ en = "Evening", de = "Abend" })"}).title, "de"), "Abend");
  EXPECT_EQ(show_set({"sky.map=grid"}).sky.map, "grid");
  EXPECT_EQ(show_set({"hole.spin=1"}).spin, 1.0);
  EXPECT_THAT(setting_problem({"title=5"}), AllOf(StartsWith("--set title: title "), HasSubstr("text")));
  EXPECT_THAT(setting_problem({"hole.spin=fast"}), StartsWith("--set hole.spin: hole.spin is not a number"));
  EXPECT_THAT(setting_problem({"hole.spin=0,5"}), StartsWith("--set hole.spin: hole.spin is not a number"));
  EXPECT_THAT(setting_problem({"effects.redshift=yes"}), HasSubstr("is neither true nor false"));
}

TEST(ShowSettings, TurnOnWhatATableTurnsOn) {
  EXPECT_FALSE(show_set({}).readout);
  const Show show = show_set({"readout={}"});
  ASSERT_TRUE(show.readout);
  EXPECT_EQ(show.readout->letter_deg, 2.0);
  const Show again = parse_show(to_toml(show_set({"readout.letter_deg=3"})), "again.toml");
  ASSERT_TRUE(again.readout);
  EXPECT_EQ(again.readout->letter_deg, 3.0);
  EXPECT_THAT(setting_problem({"readout.leter_deg=3"}), HasSubstr("did you mean"));
}

TEST(ShowSettings, LaterOnesComeLater) {
  EXPECT_EQ(show_set({"hole.spin=0.5", "hole.spin=0.25"}).spin, 0.25);
  EXPECT_EQ(text_in(show_set({"title={ en = \"Evening\" }", "title.de=Abend"}).title, "de"), "Abend");
}

TEST(ShowSettings, ProblemsNameTheSettingAndTheKey) {
  EXPECT_THAT(setting_problem({"hole.spin=1.5"}), StartsWith("--set hole.spin: hole.spin is 1.5"));
  EXPECT_THAT(setting_problem({"hole.spinn=0.5"}), AllOf(StartsWith("--set hole.spinn: hole.spinn is not a known key"),
                                                         HasSubstr("did you mean \"hole.spin\"")));
  EXPECT_THAT(
      setting_problem({"camera.key.0.thetadeg=80"}),
      AllOf(StartsWith("--set camera.key.0.thetadeg: "), HasSubstr("did you mean \"camera.key.0.theta_deg\"?")));
  EXPECT_THAT(setting_problem({"hol.spin=0.5"}),
              AllOf(StartsWith("--set hol.spin: hol is not a known key"), HasSubstr("did you mean \"hole\"")));
  EXPECT_THAT(setting_problem({"camera.key.1.r=1"}), StartsWith("--set camera.key.1.r: camera.key[1].r is 1 M"));
  EXPECT_THAT(setting_problem({"camera.key.2.r=9"}),
              AllOf(StartsWith("--set camera.key.2.r: camera.key has no entry 2"), HasSubstr("has 2 such entries")));
  EXPECT_THAT(setting_problem({"camera.key.first.r=9"}), HasSubstr("camera.key has no entry first"));
  EXPECT_THAT(setting_problem({"hole.spin.x=9"}), HasSubstr("hole.spin is a single value in evening.toml"));
}

TEST(ShowSettings, OfOtherKeysLeaveTheFileToBlame) {
  EXPECT_THAT(setting_problem({"hole.spin=0", "camera.key.1.r=9", "camera.key.0.t_s=20"}),
              AllOf(StartsWith("evening.toml:11"), HasSubstr("camera.key[1].t_s")));
}

TEST(ShowSettings, ThatAreNoneAreRefused) {
  EXPECT_THAT(setting_problem({"hole.spin"}),
              AllOf(StartsWith("--set hole.spin: has no value"), HasSubstr("KEY=VALUE")));
  for (const char* const path :
       {"=1", ".=1", "hole.=1", "hole..spin=1", "hole spin=1", "ho\"le=1", "a[0]b=1", "[0=1"}) {
    EXPECT_THAT(setting_problem({path}), HasSubstr("is not the path of a key")) << path;
  }
  EXPECT_THAT(setting_problem({"camera.observer.toward=[0, 0"}), HasSubstr("has a malformed value: [0, 0"));
  EXPECT_THAT(setting_problem({"title=\xff"}), HasSubstr("not valid UTF-8"));
  EXPECT_THAT(setting_problem({"title=A\x1b[2J"}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(setting_problem({"title=" + std::string(100, '[')}),
              AllOf(StartsWith("--set title:"), HasSubstr("deeper")));
  EXPECT_THAT(setting_problem({"title=\"A\"\nduration_s = 5"}), Not(testing::IsEmpty()));
}

TEST(ShowSettings, StandWhereKeysAreSaidToBe) {
  const Show show = show_set({"hole.spin=0.5", "view.size_px=64"});
  EXPECT_EQ(location_of(show, "hole.spin"), "--set");
  EXPECT_EQ(location_of(show, "view.size_px"), "--set");
  EXPECT_EQ(location_of(show, "sky.map"), "evening.toml:14");
  EXPECT_EQ(location_of(show, "sky.stars"), "evening.toml");
}

}  // namespace
}  // namespace ergodome
