#include "app/pads/pad_settings.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "app/pads/state/pad_names.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr const char* whole = R"(stuck_after_s = 60
[default]
left_stick = { dead_zone = 0.2 }
[[pad]]
device = "054c:0ce6"
serial = "d0:bc"
mode_switch = true
right_stick = { dead_zone = 0.1, full_at = 0.9, exponent = 2, expo = 0.25 }
invert = ["left_y", "move_up"]
buttons = ["south", "none", "guide"]
axes = { rz = "-right_y", slider = "none" }
calibration = { left_x = [3, 127, 250] }
)";

PadSettings whole_settings() {
  PadSettings settings;
  settings.stuck_after_s = 60.0;
  settings.otherwise.left_stick.dead_zone = 0.2;
  PadProfile pad = settings.otherwise;
  pad.device = "054c:0ce6";
  pad.serial = "d0:bc";
  pad.mode_switch = true;
  pad.right_stick = {0.1, 0.9, 2.0, 0.25};
  pad.inverted.set(static_cast<std::size_t>(PadAxis::left_y));
  pad.inverted.set(static_cast<std::size_t>(PadAxis::move_up));
  pad.buttons = {PadButton::south, std::nullopt, PadButton::guide};
  pad.axes = {{"rz", {PadAxis::right_y, true}}, {"slider", {std::nullopt, false}}};
  pad.calibration = {{"left_x", {3, 127, 250}}};
  settings.pads = {pad};
  return settings;
}

std::string pad_problem(const std::string& text) {
  return error_of([&] { parse_pad_settings(text, "pads.toml"); });
}

TEST(PadSettings, AreReadAsTheyAreWritten) { EXPECT_EQ(parse_pad_settings(whole, "pads.toml"), whole_settings()); }

TEST(PadSettings, ComeBackFromTheirOwnText) {
  EXPECT_EQ(parse_pad_settings(to_toml(whole_settings()), "again.toml"), whole_settings());
  EXPECT_EQ(parse_pad_settings(to_toml(PadSettings{}), "again.toml"), PadSettings{});
  EXPECT_EQ(parse_pad_settings("", "empty.toml"), PadSettings{});
}

TEST(PadSettings, ComeBackWithNamesThatNeedQuotes) {
  PadSettings settings;
  PadProfile pad;
  pad.name = "Pad \"\\ \u00e9";
  settings.pads = {pad};
  EXPECT_EQ(parse_pad_settings(to_toml(settings), "again.toml"), settings);
}

TEST(PadSettings, SayWhatTheirLinesDo) {
  EXPECT_THAT(to_toml(PadSettings{}), HasSubstr("# dead_zone: deflections below"));
  EXPECT_THAT(to_toml(PadSettings{}), HasSubstr("# A deflected stick"));
}

TEST(PadSettings, NameFileLineAndTheNearestWord) {
  EXPECT_THAT(pad_problem("stuck_after = 3\n"),
              HasSubstr("pads.toml:1: stuck_after is not a known key; did you mean \"stuck_after_s\"?"));
  EXPECT_THAT(pad_problem("[default]\nleft_stik = {}\n"), HasSubstr("pads.toml:2: default.left_stik"));
  EXPECT_THAT(pad_problem("[default]\nleft_stick = { deadzone = 0.1 }\n"), HasSubstr("did you mean \"dead_zone\"?"));
  EXPECT_THAT(pad_problem("[default]\ninvert = [\"lefty\"]\n"), HasSubstr("did you mean \"left_y\"?"));
  EXPECT_THAT(pad_problem("[default]\nbuttons = [\"sout\"]\n"), HasSubstr("did you mean \"south\"?"));
  EXPECT_THAT(pad_problem("[default]\naxes = { rx = \"right\" }\n"),
              HasSubstr("default.axes.rx has the unknown value \"right\""));
}

TEST(PadSettings, RefuseWhatCannotBe) {
  EXPECT_THAT(pad_problem("[default]\nleft_stick = { dead_zone = 0.5, full_at = 0.5 }\n"),
              HasSubstr("not at least 0.05 larger than dead_zone"));
  EXPECT_THAT(pad_problem("[default]\nleft_stick = { dead_zone = nan }\n"), HasSubstr("is nan, outside 0 to 0.9"));
  EXPECT_THAT(pad_problem("[default]\ncalibration = { x = [5, 4, 6] }\n"), HasSubstr("is not in rising order"));
  EXPECT_THAT(pad_problem("[default]\ncalibration = { x = [5, 5, 5] }\n"), HasSubstr("is not in rising order"));
  EXPECT_THAT(pad_problem("[[pad]]\n"), HasSubstr("is missing, and so are name and serial"));
  EXPECT_THAT(pad_problem("[[pad]]\ndevice = \"054C:0CE6\"\n"), HasSubstr("lower-case hex"));
}

TEST(PadSettings, RefuseAnAxisThatNoControllerHas) {
  EXPECT_EQ(pad_problem("[default.axes]\nslider_2 = \"left_x\"\nsimple_left_x = \"none\"\n"), "");
  EXPECT_THAT(pad_problem("[default.axes]\nx = \"left_x\"\nslidr = \"left_y\"\n"),
              HasSubstr("pads.toml:3: default.axes.slidr is not an axis of a controller; did you mean \"slider\"?"));
  EXPECT_THAT(pad_problem("[default.calibration]\nbanana = [0, 1, 2]\n"),
              HasSubstr("pads.toml:2: default.calibration.banana is not an axis of a controller"));
  for (const char* name : {"x_1", "x_25", "x_02", "x_", "left_x_2", "\"\""}) {
    EXPECT_THAT(pad_problem(std::string("[default.axes]\n") + name + " = \"none\"\n"), HasSubstr("is not an axis"))
        << name;
  }
}

TEST(PadSettings, RefuseASecondPadForTheSameControllers) {
  const std::string device = "[[pad]]\ndevice = \"054c:0ce6\"\n";
  EXPECT_THAT(pad_problem(device + device),
              HasSubstr("pads.toml:4: pad[2].device is already used by pad[1]; merge both [[pad]] tables"));
  EXPECT_EQ(pad_problem(device + device + "serial = \"1\"\n" + device + "name = \"Pad\"\n"), "");
  EXPECT_THAT(pad_problem("[[pad]]\nserial = \"1\"\n[[pad]]\nserial = \"1\"\n"),
              HasSubstr("pads.toml:4: pad[2].serial"));
}

TEST(PadSettings, OfASerialBeatThoseOfADeviceWhichBeatThoseOfAName) {
  PadSettings settings;
  settings.pads.resize(3);
  settings.pads[0].name = "Pad";
  settings.pads[1].device = "054c:0ce6";
  settings.pads[2].serial = "1";
  PadIdentity pad{0x054C, 0x0CE6, "Pad", "1", "USB", "", ""};
  EXPECT_EQ(&profile_for(settings, pad), &settings.pads[2]);
  pad.serial = "2";
  EXPECT_EQ(&profile_for(settings, pad), &settings.pads[1]);
  pad.product = 1;
  EXPECT_EQ(&profile_for(settings, pad), &settings.pads[0]);
  pad.name = "Other";
  EXPECT_EQ(&profile_for(settings, pad), &settings.otherwise);
}

TEST(PadNames, AreThereForEachAxisAndButton) {
  for (std::size_t i = 0; i < pad_axis_count; ++i) {
    EXPECT_EQ(pad_axis_named(name_of(static_cast<PadAxis>(i))), static_cast<PadAxis>(i));
  }
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    EXPECT_EQ(pad_button_named(name_of(static_cast<PadButton>(i))), static_cast<PadButton>(i));
  }
  EXPECT_EQ(name_of(PadButton::paddle_4), "paddle_4");
  EXPECT_EQ(name_of(PadAxis::turn_roll), "turn_roll");
}

class PadSettingsFile : public test::FolderTest {};

TEST_F(PadSettingsFile, KeepsTheOlderOne) {
  const auto path = folder_ / "new" / "pads.toml";
  PadSettings settings;
  write_pad_settings(path, settings);
  settings.stuck_after_s = 7.0;
  write_pad_settings(path, settings);
  EXPECT_EQ(load_pad_settings(path).stuck_after_s, 7.0);
  EXPECT_EQ(load_pad_settings(path.string() + ".bak").stuck_after_s, PadSettings{}.stuck_after_s);
}

TEST_F(PadSettingsFile, StandsWhereTheSystemKeepsSettings) {
  ::setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
  EXPECT_EQ(default_pad_settings_path(), folder_ / "ergodome" / "pads.toml");
  ::setenv("XDG_CONFIG_HOME", "relative", 1);
  ::setenv("HOME", folder_.c_str(), 1);
  EXPECT_EQ(default_pad_settings_path(), folder_ / ".config" / "ergodome" / "pads.toml");
  ::unsetenv("XDG_CONFIG_HOME");
  ::unsetenv("HOME");
  EXPECT_TRUE(default_pad_settings_path().empty());
}

}  // namespace
}  // namespace ergodome
