#include "app/remote/osc/osc_handler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "tests/app/remote/osc_packets.h"
#include "tests/support/fake_player.h"

namespace ergodome {
namespace {

using Kind = TransportCommand::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using test::bundle_of;
using test::packet_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

//! The OSC handler with simulated clocks, which the test sets.
class Osc : public testing::Test {
 protected:
  Osc() { board_.post(test::example_status()); }

  [[nodiscard]] OscTime in_seconds(double wait_s) const {
    return now_.of_day + static_cast<OscTime>(static_cast<std::int64_t>(wait_s * 4294967296.0));
  }

  std::vector<OscDatagram> receive(const std::vector<std::byte>& packet) {
    return handler_.receive(packet, sender_, now_);
  }

  //! Sends a message to the handler, and returns the commands for the player that result from it.
  template <class... Values>
  std::deque<TransportCommand> commands_of(const std::string& address, const char* types, Values... values) {
    SCOPED_TRACE(address);
    return commands_of_packet(packet_of(address, types, values...));
  }

  std::deque<TransportCommand> commands_of_packet(const std::vector<std::byte>& packet) {
    EXPECT_THAT(receive(packet), IsEmpty());
    return commands_.take_all();
  }

  //! Returns the text of the handler's answer, which must be a single error message.
  std::string complaint_about(const std::vector<std::byte>& packet) {
    const std::vector<OscDatagram> answers = receive(packet);
    EXPECT_THAT(commands_.take_all(), IsEmpty());
    if (answers.size() != 1) {
      return "";
    }
    const std::vector<OscMessage> messages = test::messages_in(answers[0].bytes);
    EXPECT_EQ(messages.at(0).address, "/ergodome/error");
    return std::get<std::string>(messages[0].arguments.at(1));
  }

  CommandQueue commands_;
  StatusBoard board_;
  std::vector<ClockFix> fixes_;
  std::vector<std::string> warnings_;
  OscHandler handler_{commands_,
                      board_,
                      {.clock = [this](const ClockFix& fix) { fixes_.push_back(fix); },
                       .warning = [this](const std::string& line) { warnings_.push_back(line); }}};
  NetAddress sender_ = *NetAddress::parse("127.0.0.1", 5000);
  OscInstant now_ = {steady_clock::time_point(seconds(1000)), OscTime{3'900'000'000U} << 32U};
};

TEST_F(Osc, NumbersOfEveryTypeAreHeeded) {
  EXPECT_THAT(commands_of("/ergodome/seek", "f", 1.5), ElementsAre(TransportCommand{Kind::seek, 1.5, ""}));
  EXPECT_THAT(commands_of("/ergodome/seek", "d", 0.1), ElementsAre(TransportCommand{Kind::seek, 0.1, ""}));
  EXPECT_THAT(commands_of("/ergodome/seek", "i", 7), ElementsAre(TransportCommand{Kind::seek, 7.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/loop", "F"), ElementsAre(TransportCommand{Kind::loop, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/loop", "f", 1.0), ElementsAre(TransportCommand{Kind::loop, 1.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/chapter", "s", "Return"), ElementsAre(TransportCommand{Kind::chapter, 2.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/language", "s", "de"), ElementsAre(TransportCommand{Kind::language, 0.0, "de"}));
}

TEST_F(Osc, ChaptersGoByTheirTitlesInAnyOfTheShowsLanguages) {
  EXPECT_THAT(commands_of("/ergodome/chapter", "s", "Rückkehr"), ElementsAre(TransportCommand{Kind::chapter, 2.0, ""}));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/chapter", "s", "Retour")), HasSubstr("no chapter has this title"));
}

TEST_F(Osc, TitlesHaveNoCaseInAnyLetters) {
  EXPECT_THAT(commands_of("/ergodome/chapter", "s", "THE FAR SIDE"),
              ElementsAre(TransportCommand{Kind::chapter, 1.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/chapter", "s", "DRÜBEN, NÄHER"),
              ElementsAre(TransportCommand{Kind::chapter, 1.0, ""}));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/chapter", "s", "dr\xfc")), HasSubstr("no chapter has this title"));
}

TEST_F(Osc, ATitleOfTheLanguageThatIsHeardComesFirst) {
  PlayerStatus status = test::example_status();
  status.chapters[0].titles.emplace_back("Return");
  board_.post(status);
  EXPECT_THAT(commands_of("/ergodome/chapter", "s", "Return"), ElementsAre(TransportCommand{Kind::chapter, 2.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/pause", "I"), ElementsAre(TransportCommand{Kind::pause, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/volume", "fc", 0.5, 'x'), ElementsAre(TransportCommand{Kind::volume, 0.5, ""}));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/loop", "I")), HasSubstr("needs true or false"));
}

TEST_F(Osc, LanguagesGoWithoutTheirCountryAndInAnyCase) {
  for (const char* tag : {"de", "DE", "de-AT", "de_CH"}) {
    EXPECT_THAT(commands_of("/ergodome/language", "s", tag), ElementsAre(TransportCommand{Kind::language, 0.0, "de"}));
  }
  EXPECT_THAT(complaint_about(packet_of("/ergodome/language", "s", "fr")), HasSubstr("choose from en, de"));
  PlayerStatus status = test::example_status();
  status.languages = {"pt", "pt-BR", "zh-Hant"};
  board_.post(status);
  EXPECT_THAT(commands_of("/ergodome/language", "s", "pt_br"),
              ElementsAre(TransportCommand{Kind::language, 0.0, "pt-BR"}));
  EXPECT_THAT(commands_of("/ergodome/language", "s", "zh-Hant-TW"),
              ElementsAre(TransportCommand{Kind::language, 0.0, "zh-Hant"}));
}

TEST_F(Osc, AClockFarFromItsBundlesTimeIsRefusedWithARemedy) {
  EXPECT_THAT(complaint_about(bundle_of(in_seconds(-3600.0), {packet_of("/ergodome/clock", "d", 20.0)})),
              AllOf(HasSubstr("3600 s in the past"), HasSubstr("synchronize the clocks of both machines")));
  EXPECT_THAT(fixes_, IsEmpty());
}

TEST_F(Osc, ButtonsActWhenPressedAndNotWhenReleased) {
  EXPECT_THAT(commands_of("/ergodome/play", ""), ElementsAre(TransportCommand{Kind::play, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/play", "f", 1.0), ElementsAre(TransportCommand{Kind::play, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/play", "f", 0.0), IsEmpty());
  EXPECT_THAT(commands_of("/ergodome/return", "F"), IsEmpty());
}

TEST_F(Osc, WhatOtherSendersSendIsUnderstood) {
  // A message without type tags, which some old senders produce.
  const std::string pause("/ergodome/pause\0", 16);
  const auto bytes = std::as_bytes(std::span(pause));
  EXPECT_THAT(commands_of_packet({bytes.begin(), bytes.end()}), ElementsAre(TransportCommand{Kind::pause, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/seek", "s", "12.5"), ElementsAre(TransportCommand{Kind::seek, 12.5, ""}));
  EXPECT_THAT(commands_of("/ergodome/loop", "s", "1"), ElementsAre(TransportCommand{Kind::loop, 1.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/play", "s", "0"), IsEmpty());
  EXPECT_THAT(commands_of("/ergodome/seek", "ffs", 1.0, 2.0, "x"), ElementsAre(TransportCommand{Kind::seek, 1.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/chapter", "s", "Return"), ElementsAre(TransportCommand{Kind::chapter, 2.0, ""}));
}

TEST_F(Osc, AddressPatternsNameEveryCommandThatTheyMatch) {
  EXPECT_THAT(commands_of("/*/pause", ""), ElementsAre(TransportCommand{Kind::pause, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/{play,pause}", ""),
              ElementsAre(TransportCommand{Kind::play, 0.0, ""}, TransportCommand{Kind::pause, 0.0, ""}));
  EXPECT_THAT(commands_of("/ergodome/vol?me", "f", 0.5), ElementsAre(TransportCommand{Kind::volume, 0.5, ""}));
}

TEST_F(Osc, WhatIsWrongIsAnsweredWithASentence) {
  EXPECT_THAT(complaint_about(packet_of("/ergodome/seek", "s", "soon")), HasSubstr("needs a number"));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/pley", "")), HasSubstr("did you mean /ergodome/play?"));
  EXPECT_THAT(complaint_about(packet_of("/other", "")), HasSubstr("unknown address"));
  EXPECT_THAT(complaint_about(packet_of("/foo", "")), HasSubstr("see reference/osc.md"));
  EXPECT_THAT(complaint_about(packet_of("/play", "")), HasSubstr("did you mean /ergodome/play?"));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/clok", "d", 1.0)), HasSubstr("did you mean /ergodome/clock?"));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/volume", "f", 1.5)), HasSubstr("from 0 to 1"));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/x*", "")), HasSubstr("matches no address"));
  EXPECT_THAT(complaint_about(packet_of("/ergodome/seek", "t", lo_timetag{1, 1})), HasSubstr("type"));
  EXPECT_THAT(complaint_about({std::byte{'?'}}), HasSubstr("address"));
}

TEST_F(Osc, AShowThatFollowsAClockSaysSoToWhoMovesItsTime) {
  PlayerStatus status = test::example_status();
  status.follows = "MIDI time code";
  board_.post(status);
  for (const char* name : {"play", "pause", "next_chapter"}) {
    now_.steady += seconds(1);
    EXPECT_THAT(complaint_about(packet_of(std::string("/ergodome/") + name, "")), HasSubstr("follows MIDI time code"));
  }
  EXPECT_THAT(complaint_about(packet_of("/ergodome/seek", "f", 3.0)), HasSubstr("follows MIDI time code"));
  EXPECT_THAT(commands_of("/ergodome/blackout", "T"), ElementsAre(TransportCommand{Kind::blackout, 1.0, ""}));
}

TEST_F(Osc, LanguagesThatTheShowDoesNotSpeakAreRefusedWithThoseItDoes) {
  EXPECT_THAT(complaint_about(packet_of("/ergodome/language", "s", "fr")), HasSubstr("choose from en, de"));
}

TEST_F(Osc, NumbersThatAreNotFiniteOrTooLargeAreRefused) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), 1e300}) {
    for (const char* name :
         {"seek", "seek_by", "speed", "exposure", "baseline", "volume", "step", "chapter", "clock"}) {
      now_.steady += seconds(1);
      EXPECT_NE(complaint_about(packet_of(std::string("/ergodome/") + name, "d", value)), "") << name << " " << value;
    }
  }
  EXPECT_THAT(fixes_, IsEmpty());
}

TEST_F(Osc, ComplaintsAreLimited) {
  std::size_t answers = 0;
  for (int i = 0; i < 1000; ++i) {
    answers += receive(packet_of("/nothing", "")).size();
  }
  EXPECT_EQ(answers, 10U);
}

TEST_F(Osc, WhatIsWrongIsALineOfTheLogAndAFloodDoesNotFillIt) {
  receive(packet_of("/ergodome/pley", ""));
  EXPECT_THAT(warnings_, ElementsAre(testing::AllOf(testing::StartsWith("OSC from 127.0.0.1: /ergodome/pley"),
                                                    HasSubstr("did you mean"))));
  for (int i = 0; i < 1000; ++i) {
    now_.steady += milliseconds(100);
    receive(packet_of("/nothing", ""));
  }
  EXPECT_NEAR(static_cast<double>(warnings_.size()), 110.0, 1.0) << "ten at once, and one a second";
}

TEST_F(Osc, CommandsNameTheAddressThatTheyCameFrom) {
  const std::deque<TransportCommand> commands = commands_of("/ergodome/play", "");
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].source, "OSC 127.0.0.1");
}

TEST_F(Osc, BundlesWaitForTheirTime) {
  receive(bundle_of(in_seconds(2.0), {packet_of("/ergodome/play", ""), packet_of("/ergodome/seek", "i", 5)}));
  EXPECT_THAT(commands_.take_all(), IsEmpty());
  EXPECT_EQ(handler_.next_tick(), now_.steady + seconds(2));
  handler_.tick(now_.steady + milliseconds(1999));
  EXPECT_THAT(commands_.take_all(), IsEmpty());
  handler_.tick(now_.steady + seconds(2));
  EXPECT_THAT(commands_.take_all(),
              ElementsAre(TransportCommand{Kind::play, 0.0, ""}, TransportCommand{Kind::seek, 5.0, ""}));
  EXPECT_FALSE(handler_.next_tick().has_value());
}

TEST_F(Osc, BundlesOfThePastAreHeededAtOnce) {
  receive(bundle_of(in_seconds(-2.0), {packet_of("/ergodome/play", "")}));
  EXPECT_EQ(commands_.take_all().size(), 1U);
}

TEST_F(Osc, BundlesOfTheFarFutureAreRefused) {
  EXPECT_THAT(complaint_about(bundle_of(in_seconds(3600.0), {packet_of("/ergodome/play", "")})), HasSubstr("3600 s"));
}

TEST_F(Osc, AFloodOfBundlesThatWaitIsBounded) {
  for (int i = 0; i < 10'000; ++i) {
    receive(bundle_of(in_seconds(1.0), {packet_of("/ergodome/play", "")}));
  }
  handler_.tick(now_.steady + seconds(2));
  EXPECT_EQ(commands_.take_all().size(), OscHandler::max_waiting);
}

TEST_F(Osc, AMasterClockIsHeard) {
  receive(packet_of("/ergodome/clock", "d", 12.25));
  receive(packet_of("/ergodome/clock", "df", 13.0, 0.5));
  receive(bundle_of(in_seconds(-0.5), {packet_of("/ergodome/clock", "d", 20.0)}));
  ASSERT_EQ(fixes_.size(), 3U);
  EXPECT_EQ(fixes_[0].show_time, milliseconds(12'250));
  EXPECT_EQ(fixes_[0].speed, 1.0);
  EXPECT_EQ(fixes_[0].right_at, now_.steady.time_since_epoch());
  EXPECT_EQ(fixes_[1].speed, 0.5);
  EXPECT_EQ(fixes_[2].right_at, (now_.steady - milliseconds(500)).time_since_epoch());
}

TEST_F(Osc, AMastersWordIsHeardWhenItComesWhateverItsMachinesClockSays) {
  for (const double ahead_s : {-5.0, 5.0}) {
    receive(bundle_of(in_seconds(ahead_s), {packet_of("/ergodome/clock", "d", 20.0)}));
    EXPECT_EQ(fixes_.back().heard, now_.steady.time_since_epoch());
    EXPECT_EQ(fixes_.back().right_at, now_.steady.time_since_epoch() + show_time(ahead_s));
  }
}

TEST_F(Osc, AClockThatNobodyFollowsIsRefused) {
  OscHandler deaf(commands_, board_, OscListeners());
  const auto answers = deaf.receive(packet_of("/ergodome/clock", "d", 1.0), sender_, now_);
  ASSERT_EQ(answers.size(), 1U);
  const OscMessage complaint = test::messages_in(answers[0].bytes).at(0);
  EXPECT_THAT(std::get<std::string>(complaint.arguments.at(1)), HasSubstr("start the player with --clock osc"));
}

TEST_F(Osc, SubscribersAreToldTenTimesASecondUntilTheyExpire) {
  receive(packet_of("/ergodome/subscribe", ""));
  int packets = 0;
  steady_clock::time_point now = now_.steady;
  for (; now < now_.steady + seconds(60); now += milliseconds(10)) {
    for (const OscDatagram& datagram : handler_.tick(now)) {
      EXPECT_EQ(datagram.to, sender_);
      ++packets;
    }
  }
  EXPECT_EQ(packets, 300);
  EXPECT_FALSE(handler_.next_tick().has_value());
}

TEST_F(Osc, SubscribersThatRenewStay) {
  for (int i = 0; i < 4; ++i) {
    receive(packet_of("/ergodome/subscribe", "si", "127.0.0.1", 9001));
    now_.steady += seconds(20);
    EXPECT_THAT(handler_.tick(now_.steady), testing::SizeIs(1)) << i;
  }
  receive(packet_of("/ergodome/unsubscribe", "si", "127.0.0.1", 9001));
  EXPECT_THAT(handler_.tick(now_.steady + seconds(1)), IsEmpty());
}

TEST_F(Osc, SubscribersAreFew) {
  for (int port = 6000; port < 6100; ++port) {
    receive(packet_of("/ergodome/subscribe", "i", port));
  }
  EXPECT_EQ(handler_.tick(now_.steady).size(), OscSubscribers::max_subscribers);
}

TEST_F(Osc, NobodyFromOutsideSubscribesOthers) {
  sender_ = *NetAddress::parse("192.0.2.7", 5000);
  EXPECT_THAT(receive(packet_of("/ergodome/subscribe", "si", "192.0.2.99", 80)), IsEmpty());
  EXPECT_THAT(receive(packet_of("/ergodome/subscribe", "si", "example.org", 80)), IsEmpty());
  EXPECT_THAT(receive(packet_of("/ergodome/subscribe", "i", 70'000)), IsEmpty());
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("only this machine"), HasSubstr("numeric address"), HasSubstr("65535")));
  EXPECT_THAT(handler_.tick(now_.steady), IsEmpty());
}

//! Returns the nonce in the handler's only answer. The receiver must send it back to prove its
//! address.
int nonce_in(const std::vector<OscDatagram>& answers, const NetAddress& to) {
  if (answers.size() != 1 || !(answers[0].to == to)) {
    return 0;
  }
  const OscMessage message = test::messages_in(answers[0].bytes).at(0);
  return message.address == "/ergodome/nonce" ? static_cast<int>(std::get<double>(message.arguments.at(0))) : 0;
}

TEST_F(Osc, SendsFeedbackOutsideOnlyToAddressesThatSendTheirNumberBack) {
  sender_ = *NetAddress::parse("192.0.2.7", 5000);
  const int nonce = nonce_in(receive(packet_of("/ergodome/subscribe", "")), sender_);
  ASSERT_GT(nonce, 0);
  EXPECT_THAT(handler_.tick(now_.steady), IsEmpty());
  for (const int wrong : {nonce - 1, nonce + 1, 0, -nonce}) {
    receive(packet_of("/ergodome/nonce", "i", wrong));
  }
  EXPECT_THAT(handler_.tick(now_.steady), IsEmpty());
  // Many control surfaces can send only floats, so the nonce is also accepted as a float.
  EXPECT_THAT(receive(packet_of("/ergodome/nonce", "f", static_cast<double>(nonce))), IsEmpty());
  EXPECT_THAT(handler_.tick(now_.steady), testing::SizeIs(1));
  now_.steady += OscSubscribers::subscription;
  EXPECT_THAT(handler_.tick(now_.steady), IsEmpty());
}

TEST_F(Osc, ANumberIsForOneAddressAndForAMinute) {
  sender_ = *NetAddress::parse("192.0.2.7", 5000);
  const NetAddress display = *NetAddress::parse("192.0.2.7", 9001);
  const int nonce = nonce_in(receive(packet_of("/ergodome/subscribe", "i", 9001)), display);
  ASSERT_GT(nonce, 0);
  receive(packet_of("/ergodome/nonce", "i", nonce));
  EXPECT_THAT(handler_.tick(now_.steady), IsEmpty()) << "that is port 5000";
  receive(packet_of("/ergodome/nonce", "ii", nonce, 9001));
  EXPECT_THAT(handler_.tick(now_.steady), ElementsAre(testing::Field(&OscDatagram::to, display)));
  now_.steady += OscSubscribers::nonce_lifetime + seconds(1);
  handler_.tick(now_.steady);
  receive(packet_of("/ergodome/nonce", "ii", nonce, 9001));
  EXPECT_THAT(handler_.tick(now_.steady), IsEmpty());
}

TEST_F(Osc, ToStrangersNoAnswerIsLongerThanTheirPacket) {
  sender_ = *NetAddress::parse("192.0.2.7", 5000);
  std::vector<std::vector<std::byte>> packets = {{std::byte{'?'}},
                                                 packet_of("/ergodome/ping", ""),
                                                 packet_of("/ergodome/subscribe", ""),
                                                 packet_of("/ergodome/subscribe", "i", 9001),
                                                 packet_of("/ergodome/pley", ""),
                                                 packet_of("/ergodome/nonce", "i", 7),
                                                 packet_of("/ergodome/chapter", "s", std::string(300, 'x').c_str())};
  std::vector<std::vector<std::byte>> several(60, packet_of("/ergodome/subscribe", ""));
  packets.push_back(bundle_of(osc_at_once, several));
  std::size_t answered = 0;
  for (const std::vector<std::byte>& packet : packets) {
    now_.steady += seconds(1);
    std::size_t bytes = 0;
    for (const OscDatagram& answer : receive(packet)) {
      bytes += answer.bytes.size();
      ++answered;
    }
    EXPECT_LE(bytes, packet.size());
  }
  EXPECT_GE(answered, 3U) << "pings and subscriptions are answered";
}

TEST_F(Osc, ListedSubscribersNeedNotAsk) {
  const NetAddress surface = *NetAddress::parse("192.0.2.7", 9001);
  OscHandler handler(commands_, board_, OscListeners(), {surface});
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(handler.tick(now_.steady), ElementsAre(testing::Field(&OscDatagram::to, surface)));
    now_.steady += seconds(100);
  }
  const NetAddress other_port = *NetAddress::parse("192.0.2.7", 5000);
  EXPECT_THAT(handler.receive(packet_of("/ergodome/pley", ""), other_port, now_), testing::SizeIs(1))
      << "it is told what is wrong";
}

TEST_F(Osc, FeedbackSaysWhatThePlayerDoes) {
  PlayerStatus status = test::example_status();
  status.time_s = 1e9 + 0.25;
  status.title = std::string(500, 'x');
  status.clock = "OSC, not heard yet";
  board_.post(status);
  receive(packet_of("/ergodome/subscribe", ""));
  const std::vector<OscDatagram> feedback = handler_.tick(now_.steady);
  ASSERT_EQ(feedback.size(), 1U);
  EXPECT_LT(feedback[0].bytes.size(), 1472U) << "more than a packet of Ethernet holds";
  std::map<std::string, std::vector<OscArgument>> reported;
  for (const OscMessage& message : test::messages_in(feedback[0].bytes)) {
    reported[message.address] = message.arguments;
  }
  EXPECT_EQ(reported.at("/ergodome/status/time_exact"), std::vector<OscArgument>{1e9 + 0.25});
  EXPECT_EQ(reported.at("/ergodome/status/clock"), std::vector<OscArgument>{std::string("OSC, not heard yet")});
  EXPECT_EQ(reported.at("/ergodome/status/playing"), std::vector<OscArgument>{false});
  EXPECT_EQ(reported.at("/ergodome/status/chapter"), (std::vector<OscArgument>{0.0, std::string("Departure")}));
}

}  // namespace
}  // namespace ergodome
