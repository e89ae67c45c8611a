#include <gmock/gmock.h>

#include "app/pads/pad_settings.h"
#include "tests/app/cli/command_line.h"

namespace ergodome::test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string fixture(const std::string& name) {
  return " --fixture '" ERGODOME_TEST_DATA_DIR "/hid/" + name + ".toml' ";
}

//! Tests `ergodome pad` with its own settings folder, so that the settings of the person who runs
//! the tests have no effect.
class PadCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    ::setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("XDG_CONFIG_HOME");
    CommandLine::TearDown();
  }
};

TEST_F(PadCommand, ListsControllersAndTheRemedyForThoseWithoutPermission) {
  ASSERT_EQ(run("pad" + fixture("two_identical")), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("Wireless Controller  054c:09cc  USB  /dev/hidraw3\n   read as DualShock 4\n"));
  EXPECT_THAT(output_, HasSubstr("/dev/hidraw4"));
  EXPECT_THAT(output_, HasSubstr("no permission to read /dev/hidraw6; install the udev rules 69-ergodome.rules"));
}

TEST_F(PadCommand, SaysWhereThereIsNone) {
  ASSERT_EQ(run("pad" + fixture("mouse_and_keyboard")), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("no controllers found"));
  ASSERT_EQ(run("pad"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("no settings file found"));
}

TEST_F(PadCommand, ShowsLiveValuesInPlainLines) {
  ASSERT_EQ(run("pad --live --for 3" + fixture("two_identical")), 0) << output_;
  EXPECT_THAT(
      output_,
      HasSubstr("1 Wireless Controller (USB): left +1.00 +0.00  right +0.00 +0.00  triggers 0.00 0.00  south\n"));
  EXPECT_THAT(output_, HasSubstr("2 Wireless Controller (USB): left +0.00 +1.00"));
  EXPECT_THAT(output_, HasSubstr("1 Wireless Controller (USB): unplugged\n"));
  EXPECT_THAT(output_, Not(HasSubstr("\x1b")));
}

TEST_F(PadCommand, WritesSettingsThatItReads) {
  ASSERT_EQ(run("pad --out pads.toml" + fixture("stadia")), 0) << output_;
  const PadSettings settings = load_pad_settings(folder_ / "pads.toml");
  ASSERT_EQ(settings.pads.size(), 1U);
  EXPECT_EQ(settings.pads[0].device, "18d1:9400");
  EXPECT_EQ(settings.pads[0].serial, "9A120CACHS34");
  ASSERT_EQ(run("pad --settings pads.toml" + fixture("stadia")), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("settings: [[pad]] 1\n"));
}

TEST_F(PadCommand, MeasuresAControllerAndKeepsWhatItFound) {
  ASSERT_EQ(run("pad --calibrate --for 30" + fixture("calibration")), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("left_x: 20 to 240, center 131"));
  EXPECT_THAT(output_, HasSubstr("hardly moved: right_trigger"));
  const PadSettings settings = load_pad_settings(folder_ / "config" / "ergodome" / "pads.toml");
  ASSERT_EQ(settings.pads.size(), 1U);
  EXPECT_EQ(settings.pads[0].device, "054c:0ce6");
  EXPECT_EQ(settings.pads[0].calibration.at("left_x"), (AxisCalibration{20, 131, 240}));
  EXPECT_EQ(settings.pads[0].calibration.at("left_trigger"), (AxisCalibration{0, 0, 240}));
}

TEST_F(PadCommand, WritesNothingWhereNothingWasMoved) {
  write("still.toml",
        "[[device]]\nvid = \"046d\"\npid = \"c216\"\nusage = \"1:4\"\n[[device.event]]\nhex = \"807f807f08000000\"\n");
  EXPECT_EQ(run("pad --calibrate --for 10 --out pads.toml --fixture still.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("nothing was written"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pads.toml"));
}

TEST_F(PadCommand, EndsWithOneLineWhereAFileIsBroken) {
  write("pads.toml", "[default]\nleft_stick = { dead_zone = 2 }\n");
  EXPECT_EQ(run("pad --settings pads.toml"), 1);
  EXPECT_THAT(output_, HasSubstr("pads.toml:2: default.left_stick.dead_zone is 2, outside 0 to 0.9"));
  EXPECT_EQ(run("pad --settings missing.toml"), 1);
  EXPECT_EQ(run("pad --fixture missing.toml"), 1);
  EXPECT_EQ(run("pad --live --calibrate"), 2);
}

}  // namespace
}  // namespace ergodome::test
