#include <gmock/gmock.h>

#include <cmath>

#include "tests/app/pads/pad_hub_scene.h"

namespace ergodome::test {
namespace {

TEST_F(PadHubTest, IsAtRestInTheFrameAfterAPadIsPulled) {
  play(device("/dev/hidraw0") + report_at(0, ds4()) + report_at(100, ds4(255, 0, 0x20)) + at(200, "disconnect = true"));
  EXPECT_TRUE(frame_at(0.199).merged().pressed(PadButton::south));
  const PadSnapshot gone = frame_at(0.2);
  EXPECT_EQ(gone.merged(), PadState{});
  ASSERT_EQ(gone.pads.size(), 1U);
  EXPECT_FALSE(gone.pads[0].connected);
  EXPECT_TRUE(frame_at(0.3).pads.empty());
}

TEST_F(PadHubTest, KeepsAPressMadeJustBeforeThePadWasPulled) {
  play(device("/dev/hidraw0") + report_at(0, ds4()) + report_at(101, ds4(255, 0, 0x20)) + at(102, "disconnect = true"));
  frame_at(0.1);
  const PadSnapshot gone = frame_at(0.1 + frame_s);
  EXPECT_EQ(gone.merged(), PadState{});
  EXPECT_EQ(gone.presses(PadButton::south), 1);
}

TEST_F(PadHubTest, FindsAPadAgainAtAnotherPath) {
  play(device("/dev/hidraw0") + report_at(0, ds4()) + at(500, "disconnect = true") +
       at(3000, "connect = \"/dev/hidraw7\"") + report_at(4500, ds4(0)));
  EXPECT_EQ(frame_at(0.4).pads.at(0).number, 1);
  EXPECT_FALSE(frame_at(2.9).pads.at(0).connected);
  EXPECT_TRUE(frame_at(2.95).pads.empty());
  const PadSnapshot again = frame_at(4.6);
  ASSERT_EQ(again.pads.size(), 1U);
  EXPECT_EQ(again.pads[0].identity->path, "/dev/hidraw7");
  EXPECT_EQ(again.pads[0].number, 1);
  EXPECT_EQ(again.merged().axis(PadAxis::left_x), -1.0F);
}

TEST_F(PadHubTest, FindsAPadThatIsPluggedInWithinASecondOrSo) {
  play(device("/dev/hidraw0", "present = false\n") + at(2500, "connect = \"\"") +
       report_at(2501, ds4(), "every_ms = 4\ncount = 1000\n"));
  EXPECT_TRUE(frame_at(2.4).pads.empty());
  EXPECT_EQ(frame_at(3.6).pads.size(), 1U);
}

TEST_F(PadHubTest, OpensAPadAnewAfterAnErrorOfReading) {
  play(device("/dev/hidraw0") + report_at(0, ds4(), "every_ms = 4\ncount = 200\n") + at(900, "error = true") +
       report_at(901, ds4(255), "every_ms = 4\ncount = 500\n"));
  EXPECT_EQ(frame_at(0.9).merged(), PadState{});
  EXPECT_EQ(frame_at(2.0).merged().axis(PadAxis::left_x), 1.0F);
}

TEST_F(PadHubTest, GoesOnWithTheOtherOfTwoWhenOneIsPulled) {
  play(device("/dev/hidraw3") + report_at(0, ds4(255)) + at(100, "disconnect = true") + device("/dev/hidraw4") +
       report_at(0, ds4(128, 0)) + report_at(150, ds4(0, 128)));
  const PadSnapshot snapshot = frame_at(0.2);
  EXPECT_EQ(snapshot.merged().axis(PadAxis::left_x), -1.0F);
  EXPECT_EQ(snapshot.merged().axis(PadAxis::left_y), 0.0F);
}

TEST_F(PadHubTest, LeavesOutAStickThatIsStuckUntilItMoves) {
  PadSettings settings;
  settings.stuck_after_s = 30.0;
  // The x axis stays at its maximum for a minute, while the y axis moves; then the x axis moves
  // again.
  std::string timeline = report_at(0, ds4());
  for (int t_ms = 100; t_ms < 60'000; t_ms += 500) {
    timeline += report_at(t_ms, ds4(255, (t_ms / 500) % 2 == 0 ? 0 : 10));
  }
  play(device("/dev/hidraw0") + timeline + report_at(60'000, ds4(150)) + report_at(60'100, ds4(255)), settings);
  EXPECT_FALSE(frame_at(29.9).pads.at(0).stuck);
  const PadSnapshot stuck = frame_at(30.5);
  EXPECT_TRUE(stuck.pads.at(0).stuck);
  EXPECT_EQ(stuck.merged().axis(PadAxis::left_x), 0.0F);
  EXPECT_GT(stuck.merged().axis(PadAxis::left_y), 0.9F);
  const PadSnapshot loose = frame_at(60.2);
  EXPECT_FALSE(loose.pads.at(0).stuck);
  EXPECT_EQ(loose.merged().axis(PadAxis::left_x), 1.0F);
}

TEST_F(PadHubTest, AStuckStickThatTremblesIsStillStuck) {
  PadSettings settings;
  settings.stuck_after_s = 10.0;
  play(device("/dev/hidraw0") + report_at(0, ds4(230), "every_ms = 500\ncount = 30\n") +
           report_at(15'000, ds4(232), "every_ms = 100\ncount = 10\n"),
       settings);
  EXPECT_TRUE(frame_at(15.5).pads.at(0).stuck);
}

TEST_F(PadHubTest, WatchesForNothingStuckWhereItIsToldSo) {
  PadSettings settings;
  settings.stuck_after_s = 0.0;
  play(device("/dev/hidraw0") + report_at(0, ds4(255), "every_ms = 500\ncount = 1000\n"), settings);
  EXPECT_EQ(frame_at(400.0).merged().axis(PadAxis::left_x), 1.0F);
}

TEST_F(PadHubTest, SaysHowToGetPermissionAndOpensOnceItIsThere) {
  play(device("/dev/hidraw0", "permission = false\n") + at(2000, "permission = true") +
       report_at(2001, ds4(255), "every_ms = 10\ncount = 300\n"));
  const PadSnapshot denied = frame_at(0.5);
  ASSERT_EQ(denied.pads.size(), 1U);
  EXPECT_FALSE(denied.pads[0].connected);
  EXPECT_THAT(denied.pads[0].problem, testing::HasSubstr("no permission to read /dev/hidraw0"));
  EXPECT_THAT(denied.pads[0].problem, testing::HasSubstr("69-ergodome.rules"));
  const PadSnapshot allowed = frame_at(3.5);
  ASSERT_EQ(allowed.pads.size(), 1U);
  EXPECT_EQ(allowed.pads[0].problem, "");
  EXPECT_EQ(allowed.merged().axis(PadAxis::left_x), 1.0F);
}

TEST_F(PadHubTest, LeavesAloneWhatIsNoPadAndWhatIsToBeIgnored) {
  PadSettings settings;
  settings.pads.emplace_back().device = "054c:09cc";
  settings.pads.back().ignore = true;
  play("[[device]]\nvid = \"1234\"\npid = \"0001\"\n" + at(0, "hex = \"01\"") +
           "[[device]]\npath = \"/dev/hidraw1\"\nvid = \"1234\"\npid = \"0002\"\nusage = \"1:2\"\n" +
           at(0, "hex = \"01\"") + device("/dev/hidraw2") + report_at(0, ds4(255)),
       settings);
  EXPECT_TRUE(frame_at(0.5).pads.empty());
}

TEST_F(PadHubTest, APadThatStreamsAndFallsSilentIsLetGo) {
  play(device("/dev/hidraw0") + report_at(0, ds4(255), "every_ms = 4\ncount = 250\n"));
  EXPECT_EQ(frame_at(1.5).merged().axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(frame_at(2.1).merged(), PadState{});
  EXPECT_TRUE(hub_->snapshot().pads.at(0).connected);
}

TEST_F(PadHubTest, APadThatReportsChangesAloneIsHeld) {
  play("[[device]]\nvid = \"046d\"\npid = \"c216\"\nusage = \"1:4\"\n" + report_at(0, "ff80808008000000"));
  EXPECT_EQ(frame_at(60.0).merged().axis(PadAxis::left_x), 1.0F);
}

TEST_F(PadHubTest, APuckWhoseZerosAreLostIsLetGoSoon) {
  play("[[device]]\nvid = \"046d\"\npid = \"c626\"\nusage = \"1:8\"\n" + report_at(0, "015e0100000000"));
  EXPECT_EQ(frame_at(0.4).merged().axis(PadAxis::move_right), 1.0F);
  EXPECT_EQ(frame_at(0.6).merged(), PadState{});
}

TEST_F(PadHubTest, AReceiverWithoutItsPadIsAtRest) {
  std::string absent = ds4(255);
  absent[63] = '4';  // The 4 in byte 31 means that the receiver has no controller.
  play("[[device]]\nvid = \"054c\"\npid = \"0ba0\"\nusage = \"1:5\"\n" + report_at(0, ds4(255)) +
       report_at(100, absent));
  EXPECT_EQ(frame_at(0.09).merged().axis(PadAxis::left_x), 1.0F);
  const PadSnapshot snapshot = frame_at(0.1);
  EXPECT_EQ(snapshot.merged(), PadState{});
  EXPECT_TRUE(snapshot.pads.at(0).absent);
}

TEST_F(PadHubTest, CountsWhatItDoesNotUnderstand) {
  play(device("/dev/hidraw0") + report_at(0, ds4(255)) + report_at(10, "0180") + report_at(20, "77"));
  const PadSnapshot snapshot = frame_at(0.1);
  EXPECT_EQ(snapshot.pads.at(0).reports, 3);
  EXPECT_EQ(snapshot.pads.at(0).refused, 2);
  EXPECT_EQ(snapshot.merged().axis(PadAxis::left_x), 1.0F);
}

}  // namespace
}  // namespace ergodome::test
