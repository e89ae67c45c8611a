#include "app/remote/osc/osc_message.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/app/remote/osc_packets.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::bundle_of;
using test::error_of;
using test::packet_of;

std::string refusal(const std::vector<std::byte>& packet) {
  return error_of([&] { parse_osc(packet); });
}

TEST(OscPackets, GiveEveryTypeAsItComes) {
  const std::vector<OscMessage> messages =
      parse_osc(packet_of("/a", "ihfdsTFN", 3, std::int64_t{-4}, 0.5, 0.25, "text"));
  const std::vector<OscArgument> expected = {3.0, -4.0, 0.5, 0.25, std::string("text"), true, false, std::monostate{}};
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].address, "/a");
  EXPECT_EQ(messages[0].arguments, expected);
  EXPECT_EQ(messages[0].time, osc_at_once);
}

TEST(OscPackets, GiveTheBytesOfTheSpecificationsExample) {
  // The packet is an example from the OSC 1.0 specification ("OSC Message Examples"):
  // /oscillator/4/frequency with the float 440.
  const unsigned char bytes[] = {0x2f, 0x6f, 0x73, 0x63, 0x69, 0x6c, 0x6c, 0x61, 0x74, 0x6f, 0x72,
                                 0x2f, 0x34, 0x2f, 0x66, 0x72, 0x65, 0x71, 0x75, 0x65, 0x6e, 0x63,
                                 0x79, 0x00, 0x2c, 0x66, 0x00, 0x00, 0x43, 0xdc, 0x00, 0x00};
  const std::vector<OscMessage> messages = parse_osc(std::as_bytes(std::span(bytes)));
  EXPECT_EQ(messages.at(0), (OscMessage{"/oscillator/4/frequency", {440.0}, osc_at_once}));
  const OscOutput same = {"/oscillator/4/frequency", {440.0F}};
  const std::vector<char> written = osc_packet({&same, 1});
  EXPECT_TRUE(std::equal(written.begin(), written.end(), reinterpret_cast<const char*>(bytes),
                         reinterpret_cast<const char*>(bytes) + sizeof bytes));
}

TEST(OscPackets, GiveBundlesTheirTimesAndOrder) {
  constexpr OscTime time = (OscTime{3'900'000'000U} << 32U) | 0x80000000U;
  const std::vector<OscMessage> messages = parse_osc(
      bundle_of(time, {packet_of("/a", ""), bundle_of(time + 1, {packet_of("/b", "")}), packet_of("/c", "")}));
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0], (OscMessage{"/a", {}, time}));
  EXPECT_EQ(messages[1], (OscMessage{"/b", {}, time + 1}));
  EXPECT_EQ(messages[2], (OscMessage{"/c", {}, time}));
}

TEST(OscPackets, ReadBackWhatIsWritten) {
  const std::vector<OscOutput> outputs = {{"/one", {true, OscInteger{-7}}},
                                          {"/two", {OscDouble{1e9 + 0.125}, std::string("three")}}};
  const std::vector<OscMessage> messages = test::messages_in(osc_packet(outputs));
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0], (OscMessage{"/one", {true, -7.0}, osc_at_once}));
  EXPECT_EQ(messages[1], (OscMessage{"/two", {1e9 + 0.125, std::string("three")}, osc_at_once}));
}

TEST(OscPackets, AreRefusedWhenTheyAreTooMuch) {
  std::vector<std::vector<std::byte>> many(max_osc_messages + 1, packet_of("/a", ""));
  EXPECT_NE(refusal(bundle_of(osc_at_once, many)).find("messages"), std::string::npos);
  std::vector<std::byte> deep = packet_of("/a", "");
  for (int i = 0; i <= deepest_osc_bundle; ++i) {
    deep = bundle_of(osc_at_once, {deep});
  }
  EXPECT_NE(refusal(deep).find("nested"), std::string::npos);
  EXPECT_NE(refusal(packet_of("/a", "s", std::string(largest_osc_packet, 'x').c_str())).find("longer"),
            std::string::npos);
  EXPECT_NE(refusal(packet_of("/a", "iiiiiiiiiiiiiiiii", 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1)), "");
}

TEST(OscPackets, AreRefusedWhenTheyAreCutOff) {
  const std::vector<std::byte> whole = bundle_of(5, {packet_of("/ergodome/seek", "ds", 1.0, "text")});
  for (std::size_t size = 17; size < whole.size(); ++size) {
    EXPECT_NE(refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
  }
  EXPECT_NE(refusal({}), "");
}

//! Returns the bytes of a literal.
std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(OscPackets, GiveArraysAsTheirElements) {
  using namespace std::string_view_literals;
  // python-osc writes a list inside an argument list as an array: here the arguments are [12.5, 1]
  // and a string.
  const auto messages = parse_osc(bytes_of("/seek\0\0\0,[fi]s\0\0\x41\x48\0\0\0\0\0\1end\0"sv));
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].arguments, (std::vector<OscArgument>{12.5, 1.0, std::string("end")}));
  EXPECT_EQ(parse_osc(bytes_of("/a\0\0,[]\0"sv)).at(0).arguments, std::vector<OscArgument>());
}

TEST(OscPackets, TakeATouchWithoutAValueAsNothing) {
  // OSC 1.1 requires the type 'I', an impulse, which has no value.
  EXPECT_EQ(parse_osc(packet_of("/a", "I")).at(0).arguments, (std::vector<OscArgument>{std::monostate{}}));
}

TEST(OscPackets, IgnoreFurtherArgumentsOfOtherTypesAndNameAFirstOne) {
  using namespace std::string_view_literals;
  // The second argument has a type that is not supported, after a number: a color (as Chataigne and
  // ossia write it), then a time tag.
  EXPECT_EQ(parse_osc(bytes_of("/a\0\0,fr\0\x3F\x80\0\0\xFF\0\0\xFF"sv)).at(0).arguments,
            (std::vector<OscArgument>{1.0, std::monostate{}}));
  EXPECT_EQ(parse_osc(packet_of("/a", "ft", 1.0, lo_timetag{1, 1})).at(0).arguments,
            (std::vector<OscArgument>{1.0, std::monostate{}}));
  EXPECT_NE(refusal(bytes_of("/a\0\0,r\0\0\xFF\0\0\xFF"sv)).find("type 'r'"), std::string::npos);
  EXPECT_NE(refusal(packet_of("/a", "t", lo_timetag{1, 1})).find("type 't'"), std::string::npos);
  EXPECT_NE(refusal(bytes_of("/a\0\0,[f]"sv)).find("type tags"), std::string::npos) << "no end";
  EXPECT_NE(refusal(bytes_of("/a\0\0,r\0\0\xFF\0"sv)), "");
}

TEST(OscPackets, AreRefusedInWords) {
  using namespace std::string_view_literals;
  const std::pair<std::string_view, const char*> cases[] = {
      {""sv, "is empty"},
      {"play"sv, "does not begin with /"},
      {"/ping"sv, "has an address that is not padded"},
      {"/a\0\0i\0\0\0"sv, "has arguments without type tags"},
      {"/a\0\0\0\0\0\0"sv, "has arguments without type tags"},
      {"/a\0\0,iii"sv, "has type tags that are not padded"},
      {"/a\0\0,i\0\0\0\0"sv, "has an argument that is truncated"},
      {"/a\0\0,s\0\0text"sv, "has an argument that is truncated"},
      {"/a\0\0,i\0\0\0\0\0\1\0\0\0\1"sv, "has a size that does not match"}};
  for (const auto& [packet, words] : cases) {
    EXPECT_NE(refusal(bytes_of(packet)).find(words), std::string::npos) << refusal(bytes_of(packet));
  }
}

TEST(OscPackets, SurviveDamage) {
  // Damaged bytes may still be a valid packet. The sanitizers check that parsing stays within
  // bounds.
  const std::vector<std::byte> whole =
      bundle_of(5, {packet_of("/ergodome/seek", "dfisTFN", 1.0, 0.5, 2, "text"), packet_of("/b", "s", "other")});
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::byte> damaged = whole;
    for (int change = 0; change < 3; ++change) {
      damaged[random() % damaged.size()] = static_cast<std::byte>(random() & 0xFFU);
    }
    refused += refusal(damaged).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
}

TEST(OscTimes, DifferInSecondsAcrossTheEraOf2036) {
  EXPECT_DOUBLE_EQ(osc_difference_s((OscTime{10} << 32U) | 0x40000000U, OscTime{8} << 32U), 2.25);
  EXPECT_DOUBLE_EQ(osc_difference_s(OscTime{1} << 32U, OscTime{0xFFFFFFFFU} << 32U), 2.0);
}

}  // namespace
}  // namespace ergodome
