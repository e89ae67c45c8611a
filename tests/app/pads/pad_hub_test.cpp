#include "app/pads/pad_hub.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/app/pads/fixtures.h"

namespace ergodome::test {
namespace {

constexpr double frame_s = 1.0 / 60.0;

//! A report of a DualShock 4 over USB: left stick, face buttons.
std::string ds4(int left_x = 128, int left_y = 128, int face = 0) {
  std::vector<std::uint8_t> report(64);
  report[0] = 1;
  report[1] = static_cast<std::uint8_t>(left_x);
  report[2] = static_cast<std::uint8_t>(left_y);
  report[3] = report[4] = 128;
  report[5] = static_cast<std::uint8_t>(8 | face);
  std::string hex;
  for (const std::uint8_t byte : report) {
    constexpr const char* digits = "0123456789abcdef";
    hex += digits[byte >> 4U];
    hex += digits[byte & 15U];
  }
  return hex;
}

std::string device(const std::string& path, const std::string& more = "") {
  return "[[device]]\npath = \"" + path + "\"\nvid = \"054c\"\npid = \"09cc\"\nusage = \"1:5\"\nname = \"Pad\"\n" +
         more;
}

std::string at(int t_ms, const std::string& what) {
  std::string event = "[[device.event]]\nt_ms = ";
  event += std::to_string(t_ms);
  return event + "\n" + what + "\n";
}

std::string report_at(int t_ms, const std::string& hex, const std::string& more = "") {
  return at(t_ms, "hex = \"" + hex + "\"\n" + more);
}

//! A hub whose time is the test's.
class PadHubTest : public testing::Test {
 protected:
  void play(const std::string& text, PadSettings settings = {}) {
    auto player = std::make_unique<FixturePlayer>(parse_hid_fixture(text, "test.toml"), [this] { return now_s_; });
    player_ = player.get();
    hub_ = std::make_unique<PadHub>(std::move(player), std::move(settings), [this] { return now_s_; });
  }

  //! What a frame at a time sees; frames in between pass unseen.
  PadSnapshot frame_at(double t_s) {
    for (; now_s_ + frame_s < t_s; now_s_ += frame_s) {
      hub_->poll();
    }
    now_s_ = t_s;
    hub_->poll();
    return hub_->snapshot();
  }

  double now_s_ = 0.0;
  FixturePlayer* player_ = nullptr;
  std::unique_ptr<PadHub> hub_;
};

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

TEST_F(PadHubTest, GoesOnWithTheOtherOfTwoWhenOneIsPulled) {
  play(device("/dev/hidraw3") + report_at(0, ds4(255)) + at(100, "disconnect = true") + device("/dev/hidraw4") +
       report_at(0, ds4(128, 0)) + report_at(150, ds4(0, 128)));
  const PadSnapshot snapshot = frame_at(0.2);
  EXPECT_EQ(snapshot.merged().axis(PadAxis::left_x), -1.0F);
  EXPECT_EQ(snapshot.merged().axis(PadAxis::left_y), 0.0F);
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
  EXPECT_EQ(first.pads.at(0).reports, PadSession::most_reports);
  EXPECT_EQ(first.pads.at(1).state.axis(PadAxis::left_y), 1.0F);
}

TEST_F(PadHubTest, LeavesOutAStickThatIsStuckUntilItMoves) {
  PadSettings settings;
  settings.stuck_after_s = 30.0;
  // Held to the right for a minute; the other axis goes on. Then it comes loose.
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

TEST_F(PadHubTest, SaysHowToGetPermissionAndOpensOnceItIsThere) {
  play(device("/dev/hidraw0", "permission = false\n") + at(2000, "permission = true") +
       report_at(2001, ds4(255), "every_ms = 10\ncount = 300\n"));
  const PadSnapshot denied = frame_at(0.5);
  ASSERT_EQ(denied.pads.size(), 1U);
  EXPECT_FALSE(denied.pads[0].connected);
  EXPECT_THAT(denied.pads[0].problem, testing::HasSubstr("no permission to read /dev/hidraw0"));
  EXPECT_THAT(denied.pads[0].problem, testing::HasSubstr("app/pads/69-ergodome.rules"));
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
  absent[63] = '4';  // Byte 31.
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

}  // namespace
}  // namespace ergodome::test
