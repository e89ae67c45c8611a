#include "app/pads/pad_hub.h"

#include <gmock/gmock.h>

#include <cmath>

#include "app/pads/pad_lines.h"
#include "tests/app/pads/pad_hub_scene.h"

namespace ergodome::test {
namespace {

TEST_F(PadHubTest, ShowsAReportInTheNextFrame) {
  play(device("/dev/hidraw0") + report_at(0, ds4()) + report_at(500, ds4(255)));
  EXPECT_EQ(frame_at(0.499).merged().axis(PadAxis::left_x), 0.0F);
  const PadSnapshot snapshot = frame_at(0.5 + frame_s);
  EXPECT_EQ(snapshot.merged().axis(PadAxis::left_x), 1.0F);
  EXPECT_LE(snapshot.time_s - 0.5, frame_s + 1e-9);
  EXPECT_EQ(snapshot.pads.at(0).identity->connection, "USB");
  EXPECT_EQ(snapshot.pads.at(0).identity->model, "DualShock 4");
}

TEST_F(PadHubTest, CountsPressesBetweenFrames) {
  play(device("/dev/hidraw0") + report_at(0, ds4()) + report_at(101, ds4(128, 128, 0x20)) + report_at(103, ds4()) +
       report_at(105, ds4(128, 128, 0x20)) + report_at(107, ds4()));
  EXPECT_EQ(frame_at(0.1).presses(PadButton::south), 0);
  const PadSnapshot snapshot = frame_at(0.1 + frame_s);
  EXPECT_FALSE(snapshot.merged().pressed(PadButton::south));
  EXPECT_EQ(snapshot.presses(PadButton::south), 2);
  EXPECT_EQ(frame_at(0.1 + 2 * frame_s).presses(PadButton::south), 0);
}

TEST_F(PadHubTest, TellsTwoIdenticalPadsApart) {
  play(device("/dev/hidraw3") + report_at(0, ds4(255)) + device("/dev/hidraw4") + report_at(0, ds4(128, 0)));
  const PadSnapshot snapshot = frame_at(0.5);
  ASSERT_EQ(snapshot.pads.size(), 2U);
  EXPECT_EQ(snapshot.pads[0].identity->serial, "");
  EXPECT_EQ(snapshot.pads[0].state.axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(snapshot.pads[0].state.axis(PadAxis::left_y), 0.0F);
  EXPECT_EQ(snapshot.pads[1].state.axis(PadAxis::left_y), 1.0F);
  EXPECT_EQ(snapshot.pads[0].number + snapshot.pads[1].number, 3);
}

TEST_F(PadHubTest, GivesOneOfTwoSettingsOfItsOwnBySerial) {
  PadSettings settings;
  PadProfile mine;
  mine.serial = "b";
  mine.inverted.set(static_cast<std::size_t>(PadAxis::left_x));
  settings.pads.push_back(mine);
  play(device("/dev/hidraw3", "serial = \"a\"\n") + report_at(0, ds4(255)) +
           device("/dev/hidraw4", "serial = \"b\"\n") + report_at(0, ds4(255)),
       settings);
  const PadSnapshot snapshot = frame_at(0.5);
  EXPECT_EQ(snapshot.pads.at(0).state.axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(snapshot.pads.at(1).state.axis(PadAxis::left_x), -1.0F);
}

TEST_F(PadHubTest, TakesOfEachAxisTheStrongest) {
  PadSnapshot snapshot;
  snapshot.pads.resize(2);
  snapshot.pads[0].state.axes[0] = 0.3F;
  snapshot.pads[1].state.axes[0] = -0.5F;
  snapshot.pads[0].state.axes[1] = -0.2F;
  snapshot.pads[0].state.buttons.set(3);
  snapshot.pads[1].state.buttons.set(5);
  const PadState merged = snapshot.merged();
  EXPECT_EQ(merged.axes[0], -0.5F);
  EXPECT_EQ(merged.axes[1], -0.2F);
  EXPECT_TRUE(merged.buttons[3] && merged.buttons[5]);
}

TEST_F(PadHubTest, ReadsAThousandReportsASecondWithoutStarvingAnother) {
  play(device("/dev/hidraw3") + report_at(0, ds4(200), "every_ms = 1\ncount = 10000\n") + device("/dev/hidraw4") +
       report_at(0, ds4()) + report_at(5000, ds4(128, 0)));
  EXPECT_EQ(frame_at(5.0).pads.at(1).state.axis(PadAxis::left_y), 1.0F);
  EXPECT_EQ(frame_at(9.9999).pads.at(0).reports, 10'000);
}

TEST_F(PadHubTest, ReadsTheOtherPadInTheRoundOfABurst) {
  play(device("/dev/hidraw3") + report_at(0, ds4(200), "every_ms = 0\ncount = 5000\n") + device("/dev/hidraw4") +
       report_at(0, ds4(128, 0)));
  now_s_ = 0.0;
  hub_->poll();
  const PadSnapshot first = hub_->snapshot();
  EXPECT_EQ(first.pads.at(0).reports, PadSession::max_reports);
  EXPECT_EQ(first.pads.at(1).state.axis(PadAxis::left_y), 1.0F);
}

TEST_F(PadHubTest, ADriftOfTwelveIn255IsRest) {
  std::string timeline;
  for (int i = 0; i < 200; ++i) {
    timeline += report_at(10 * i, ds4(128 + ((i * 7) % 25) - 12, 128 + ((i * 11) % 25) - 12));
  }
  play(device("/dev/hidraw0") + timeline);
  for (double t_s = 0.1; t_s < 2.0; t_s += 0.1) {
    EXPECT_EQ(frame_at(t_s).merged(), PadState{});
  }
}

TEST_F(PadHubTest, AsksForFullReportsOnceAndOnlyWhereItIsTold) {
  const std::string pads =
      "[[device]]\npath = \"/dev/hidraw0\"\nvid = \"054c\"\npid = \"05c4\"\nbus = \"bluetooth\"\nusage = \"1:5\"\n"
      "[[device.feature]]\nhex = \"05 00\"\n"
      "[[device]]\npath = \"/dev/hidraw1\"\nvid = \"057e\"\npid = \"2009\"\nusage = \"1:4\"\n"
      "[[device]]\npath = \"/dev/hidraw2\"\nvid = \"054c\"\npid = \"0ce6\"\nbus = \"bluetooth\"\nusage = \"1:5\"\n";
  play(pads);
  frame_at(3.0);
  EXPECT_TRUE(player_->sent_to(0).empty() && player_->sent_to(1).empty() && player_->sent_to(2).empty());

  PadSettings settings;
  settings.otherwise.mode_switch = true;
  now_s_ = 0.0;
  play(pads, settings);
  frame_at(3.0);
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(player_->sent_to(0), (std::vector<Bytes>{{0x05}}));
  EXPECT_EQ(player_->sent_to(2), (std::vector<Bytes>{{0x09}}));
  const std::vector<Bytes>& handshake = player_->sent_to(1);
  ASSERT_EQ(handshake.size(), 7U);
  const Bytes steps = {0x02, 0x03, 0x02, 0x04};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(handshake[i].size(), 64U);
    EXPECT_EQ(handshake[i][0], 0x80);
    EXPECT_EQ(handshake[i][1], steps[i]);
  }
  EXPECT_EQ(handshake[6][0], 0x01);
  EXPECT_EQ(handshake[6][10], 0x03);
  EXPECT_EQ(handshake[6][11], 0x30);
}

TEST_F(PadHubTest, TakesNewSettingsWhileItRuns) {
  play(device("/dev/hidraw0") + report_at(0, ds4(255), "every_ms = 4\ncount = 1000\n"));
  EXPECT_EQ(frame_at(0.5).merged().axis(PadAxis::left_x), 1.0F);
  PadSettings settings;
  settings.otherwise.inverted.set(static_cast<std::size_t>(PadAxis::left_x));
  hub_->use(settings);
  EXPECT_EQ(frame_at(1.0).merged().axis(PadAxis::left_x), -1.0F);
}

TEST_F(PadHubTest, KeepsNoPadsThatAreGoneWhereNobodyLooks) {
  std::string timeline;
  for (int i = 0; i < 500; ++i) {
    timeline += at(2000 * i, "connect = \"/dev/hidraw" + std::to_string(i) + "\"");
    timeline += report_at(2000 * i + 1500, ds4(255));
    timeline += at(2000 * i + 1600, "disconnect = true");
  }
  play(device("/dev/hidraw0", "present = false\n") + timeline);
  for (; now_s_ < 1000.0; now_s_ += 0.1) {
    hub_->poll();
  }
  EXPECT_LE(hub_->snapshot().pads.size(), 64U);
  EXPECT_TRUE(hub_->snapshot().pads.empty());
}

TEST_F(PadHubTest, SaysWhenAPersonDidSomethingLast) {
  play(device("/dev/hidraw0") + report_at(0, ds4(), "every_ms = 4\ncount = 500\n") + report_at(1001, ds4(255)));
  EXPECT_TRUE(std::isinf(frame_at(0.9).last_input_s()));
  EXPECT_NEAR(frame_at(2.0).last_input_s(), 1.0, 0.05);
}

TEST(PadLines, AStickAtRestBelowItsMiddleHasNoMinusSign) {
  PadView pad;
  pad.identity = std::make_shared<const PadIdentity>();
  pad.connected = true;
  pad.state.axes[static_cast<std::size_t>(PadAxis::left_x)] = -0.0F;
  EXPECT_THAT(live_line(pad), testing::HasSubstr("left +0.00 +0.00"));
}

}  // namespace
}  // namespace ergodome::test
