#include <gmock/gmock.h>

#include "app/pads/state/pad_names.h"
#include "tests/app/pads/fixtures.h"

namespace ergodome::test {
namespace {

class EveryDecoder : public testing::TestWithParam<const char*> {};

TEST_P(EveryDecoder, ReadsItsFixtureAsThePublishedLayoutHasIt) {
  const HidFixture played = fixture(GetParam());
  ASSERT_FALSE(played.source.empty());
  for (const FixtureDevice& device : played.devices) {
    const auto decoder = make_pad_decoder(device.info, device.descriptor);
    ASSERT_NE(decoder, nullptr);
    for (const RawAxis& axis : decoder->layout().axes) {
      EXPECT_TRUE(is_raw_axis_name(axis.name)) << axis.name << " cannot be set";
    }
    RawPad raw = at_rest(decoder->layout());
    int number = 0;
    for (const HidEvent& event : device.timeline) {
      SCOPED_TRACE(testing::Message() << "event " << ++number << ", " << event.bytes.size() << " bytes, expect \""
                                      << event.expect << '"');
      const RawPad before = raw;
      const Expectation expected(event.expect);
      ASSERT_EQ(decoder->decode(event.bytes, raw), expected.kind);
      if (expected.kind == PadReport::refused) {
        ASSERT_EQ(raw, before);
      } else if (expected.kind == PadReport::state || expected.kind == PadReport::other) {
        const PadState state = read_straight(decoder->layout(), raw);
        ASSERT_EQ(pressed(state), pressed(expected.state));
        ASSERT_THAT(state.axes, testing::Pointwise(testing::FloatNear(0.004F), expected.state.axes));
      }
    }
    EXPECT_GT(number, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, EveryDecoder,
                         testing::Values("dualshock4_usb", "dualshock4_bluetooth", "dualshock4_receiver",
                                         "dualsense_usb", "dualsense_bluetooth", "xbox_one_s_old", "xbox_series",
                                         "xbox_elite_2", "switch_pro_bluetooth", "switch_pro_usb", "logitech_f310",
                                         "space_navigator", "space_mouse_wireless", "8bitdo_pro_2", "saitek_x52",
                                         "stadia", "tinyusb_gamepad", "nicohood_gamepad", "luna_bluetooth", "zeroplus",
                                         "xusb_gamepad", "asus_gamepad", "raptor_mach_2"),
                         [](const auto& played) { return std::string(played.param); });

TEST_P(EveryDecoder, RefusesEveryShorterReport) {
  const HidFixture played = fixture(GetParam());
  const FixtureDevice& device = played.devices.front();
  for (const HidEvent& event : device.timeline) {
    const auto decoder = make_pad_decoder(device.info, device.descriptor);
    RawPad raw = at_rest(decoder->layout());
    // Each shortened report is in its own memory block, so that sanitizers detect reads beyond its
    // end.
    for (std::size_t length = 0; length < std::min<std::size_t>(event.bytes.size(), 80); ++length) {
      const std::vector<std::uint8_t> cut(event.bytes.begin(),
                                          event.bytes.begin() + static_cast<std::ptrdiff_t>(length));
      const PadReport kind = decoder->decode(cut, raw);
      ASSERT_TRUE(length > 0 || kind == PadReport::refused);
    }
  }
}

TEST(Checksum, IsTheCommonCrc32) {
  // CRC-32/ISO-HDLC defines the check value cbf43926 for the text "123456789".
  const std::vector<std::uint8_t> rest = {'2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32_after('1', rest), 0xCBF43926U);
}

TEST(Pads, AreNeitherMiceNorKeyboardsNorAPucksOwnKeyboard) {
  for (const FixtureDevice& device : fixture("mouse_and_keyboard").devices) {
    EXPECT_FALSE(is_pad(device.info)) << device.info.name;
    EXPECT_EQ(make_pad_decoder(device.info, device.descriptor), nullptr) << device.info.name;
  }
}

TEST(Pads, AreKnownWhereTheSystemTellsNoUsage) {
  HidDeviceInfo info;
  info.vendor = 0x054C;
  info.product = 0x0CE6;
  EXPECT_TRUE(is_pad(info));
  info.product = 0x0001;
  EXPECT_FALSE(is_pad(info));
}

TEST(Pads, OfAnUnknownMakerWithoutADescriptorCannotBeRead) {
  HidDeviceInfo info;
  info.vendor = 0x1234;
  info.usages = {{1, 5}};
  EXPECT_TRUE(is_pad(info));
  EXPECT_EQ(make_pad_decoder(info, {}), nullptr);
}

TEST(EightBitDo, SendsWhatIsNotItsOwnLayoutThroughTheDescriptor) {
  const FixtureDevice stadia = fixture("stadia").devices.front();
  HidDeviceInfo info = stadia.info;
  info.vendor = 0x2DC8;
  info.product = 0x6012;
  const auto decoder = make_pad_decoder(info, stadia.descriptor);
  RawPad raw = at_rest(decoder->layout());
  // The report has ten bytes and id 3. 8BitDo's own layout has no such report, so the pad must be
  // read by its descriptor.
  const std::vector<std::uint8_t> report = {3, 8, 0x00, 0x40, 255, 128, 128, 128, 0, 0};
  ASSERT_EQ(decoder->decode(report, raw), PadReport::state);
  const PadState state = read_straight(decoder->layout(), raw);
  EXPECT_FLOAT_EQ(state.axis(PadAxis::left_x), 1.0F);
  EXPECT_EQ(pressed(state), std::vector<std::string>{"south"});
}

}  // namespace
}  // namespace ergodome::test
