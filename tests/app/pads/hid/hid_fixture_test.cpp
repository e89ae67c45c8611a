#include <gmock/gmock.h>

#include "app/pads/hid/hid_text.h"
#include "tests/app/pads/fixtures.h"
#include "tests/support/errors.h"

namespace ergodome::test {
namespace {

using testing::HasSubstr;

const std::string pad = "[[device]]\nvid = \"054c\"\npid = \"05c4\"\n";

std::string problem_of(const std::string& text) {
  return error_of([&] { parse_hid_fixture(text, "f.toml"); });
}

TEST(HidFixture, ReadsEventsInTheOrderOfTheirTimes) {
  const HidFixture fixture =
      parse_hid_fixture(pad +
                            "usage = \"1:5 12:1\"\n[[device.event]]\nt_ms = 20\ndisconnect = true\n"
                            "[[device.event]]\nt_ms = 0\nhex = \"01 Ff\"\nevery_ms = 5\ncount = 3\n",
                        "f.toml");
  ASSERT_EQ(fixture.devices.size(), 1U);
  const FixtureDevice& device = fixture.devices[0];
  EXPECT_EQ(device.info.vendor, 0x054C);
  EXPECT_EQ(device.info.usages, (std::vector<HidUsage>{{1, 5}, {12, 1}}));
  ASSERT_EQ(device.timeline.size(), 4U);
  EXPECT_EQ(device.timeline[2].bytes, (std::vector<std::uint8_t>{0x01, 0xFF}));
  EXPECT_DOUBLE_EQ(device.timeline[2].t_s, 0.010);
  EXPECT_EQ(device.timeline[3].kind, HidEvent::Kind::disconnect);
}

TEST(HidFixture, NamesFileLineAndRemedy) {
  EXPECT_THAT(problem_of(pad + "busk = \"usb\"\n"),
              HasSubstr("f.toml:4: device[1].busk is not a known key; did you mean \"bus\""));
  EXPECT_THAT(problem_of(pad + "[[device.event]]\nhex = \"0\"\n"), HasSubstr("middle of a byte"));
  EXPECT_THAT(problem_of(pad + "[[device.event]]\nhex = \"zz\"\n"), HasSubstr("not a list of bytes in hex"));
  EXPECT_THAT(problem_of(pad + "[[device.event]]\nt_ms = 1\n"), HasSubstr("is not the only event in this table"));
  EXPECT_THAT(problem_of("[[device]]\nvid = \"54c\"\npid = \"05c4\"\n"), HasSubstr("not four hexadecimal digits"));
  EXPECT_THAT(problem_of(pad + "usage = \"pad\"\n"), HasSubstr("is not a HID usage"));
}

TEST(HidFixture, BoundsWhatRepetitionsMake) {
  EXPECT_THAT(problem_of(pad + "[[device.event]]\nhex = \"01\"\ncount = 200000\n[[device.event]]\nhex = \"01\"\n"),
              HasSubstr("too many events"));
}

TEST(HidFixture, PlaysARepeatedTimelineOverAndOver) {
  double now_s = 0.0;
  FixturePlayer player(parse_hid_fixture(pad + "repeat_ms = 100\n[[device.event]]\nt_ms = 0\nhex = \"01\"\n"
                                               "[[device.event]]\nt_ms = 50\nhex = \"02\"\n",
                                         "f.toml"),
                       [&] { return now_s; });
  const HidOpening opening = player.open_path("/dev/hidraw0");
  ASSERT_NE(opening.device, nullptr);
  std::vector<int> seen;
  std::vector<std::uint8_t> report(8);
  for (; now_s < 0.26; now_s += 0.01) {
    while (opening.device->read_timeout(report, 0) > 0) {
      seen.push_back(report[0]);
    }
  }
  EXPECT_EQ(seen, (std::vector<int>{1, 2, 1, 2, 1, 2}));
}

TEST(HidText, HasNoControlsAndNoInvalidCharacters) {
  EXPECT_EQ(text_of(nullptr), "");
  EXPECT_EQ(text_of(L""), "");
  EXPECT_EQ(text_of(L" Pad\t\x1b[31m \u00e9\u4e16\U0001F3AE "), "Pad[31m \u00e9\u4e16\U0001F3AE");
  const wchar_t odd[] = {L'a', static_cast<wchar_t>(0xD800), static_cast<wchar_t>(0x110000), L'b', L'\0'};
  EXPECT_EQ(text_of(odd), "ab");
  EXPECT_EQ(text_of(std::wstring(500, L'x').c_str()).size(), 120U);
  EXPECT_EQ(without_controls(std::string("a\0\nb", 4)), "ab");
}

}  // namespace
}  // namespace ergodome::test
