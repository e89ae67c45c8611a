#include <gmock/gmock.h>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/generic_mapping.h"
#include "app/pads/state/pad_names.h"
#include "tests/app/pads/fixtures.h"

namespace ergodome::test {
namespace {

//! A recorded pad (a fixture) with a published report layout, and the parts of the layout that the
//! HID descriptor of the pad does not contain.
struct Known {
  const char* name;
  //! True if, by the descriptor, the button of a trigger does not also move the axis of the
  //! trigger.
  bool analog_alone = false;
  //! Events with this word are skipped: a button in vendor-defined bits, which the descriptor does
  //! not explain. "~" if there is none.
  std::string_view untold;
};

std::ostream& operator<<(std::ostream& out, const Known& known) { return out << known.name; }

class KnownPad : public testing::TestWithParam<Known> {};

//! A decoder from the HID descriptor must agree with the published layout. The two are independent:
//! they share no code.
TEST_P(KnownPad, IsReadByItsDescriptorAsByItsLayout) {
  const FixtureDevice device = fixture(GetParam().name).devices.front();
  const auto decoder = make_by_descriptor(device.descriptor);
  ASSERT_NE(decoder, nullptr);
  RawPad raw = at_rest(decoder->layout());
  int compared = 0;
  for (const HidEvent& event : device.timeline) {
    const Expectation expected(event.expect);
    if (expected.kind != PadReport::state || event.expect.find(GetParam().untold) != std::string::npos) {
      continue;
    }
    SCOPED_TRACE(event.expect);
    ASSERT_EQ(decoder->decode(event.bytes, raw), PadReport::state);
    PadState state = read_straight(decoder->layout(), raw);
    PadState wanted = expected.state;
    for (const PadAxis axis : {PadAxis::left_trigger, PadAxis::right_trigger}) {
      const auto index = static_cast<std::size_t>(axis);
      if (GetParam().analog_alone && state.axes[index] == 0.0F) {
        wanted.axes[index] = 0.0F;
      }
    }
    ASSERT_EQ(pressed(state), pressed(wanted));
    ASSERT_THAT(state.axes, testing::Pointwise(testing::FloatNear(0.004F), wanted.axes));
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

INSTANTIATE_TEST_SUITE_P(Descriptors, KnownPad,
                         testing::Values(Known{"dualshock4_usb", true, "~"}, Known{"dualsense_usb", true, "paddle"},
                                         Known{"xbox_series", false, "~"}, Known{"logitech_f310", false, "~"},
                                         Known{"space_navigator", false, "~"},
                                         Known{"space_mouse_wireless", false, "~"}, Known{"saitek_x52", false, "~"},
                                         Known{"stadia", false, "~"}),
                         [](const auto& played) { return std::string(played.param.name); });

TEST(ByDescriptor, NamesAxesAsSettingsDo) {
  for (std::uint16_t page = 0; page < 0x100; ++page) {
    for (std::uint16_t usage = 0; usage < 0x400; ++usage) {
      if (const char* const name = generic_axis_name({page, usage}); name != nullptr) {
        EXPECT_TRUE(is_raw_axis_name(name)) << name;
      }
    }
  }
}

TEST(ByDescriptor, GivesNothingForAMouseOrAKeyboard) {
  for (const FixtureDevice& device : fixture("mouse_and_keyboard").devices) {
    EXPECT_EQ(make_by_descriptor(device.descriptor), nullptr) << device.info.name;
  }
}

TEST(ByDescriptor, KeepsWhatOtherReportsSaid) {
  const auto decoder = make_by_descriptor(fixture("space_navigator").devices.front().descriptor);
  RawPad raw = at_rest(decoder->layout());
  decoder->decode(std::vector<std::uint8_t>{3, 1, 0}, raw);
  decoder->decode(std::vector<std::uint8_t>{1, 0x5E, 0x01, 0, 0, 0, 0}, raw);
  EXPECT_TRUE(raw.numbered[0]);
  EXPECT_EQ(raw.values[0], 350);
  decoder->decode(std::vector<std::uint8_t>{3, 0, 0}, raw);
  EXPECT_FALSE(raw.numbered[0]);
  EXPECT_EQ(raw.values[0], 350);
}

TEST(ByDescriptor, NamesAxesOfTheSameUsageApart) {
  // The descriptor has two axes with the usage `slider`, of eight bits each.
  const std::vector<std::uint8_t> descriptor = {0x05, 0x01, 0x09, 0x04, 0xA1, 0x01, 0x09, 0x36, 0x09, 0x36, 0x15,
                                                0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x02, 0x81, 0x02, 0xC0};
  const auto decoder = make_by_descriptor(descriptor);
  ASSERT_EQ(decoder->layout().axes.size(), 2U);
  EXPECT_EQ(decoder->layout().axes[0].name, "slider");
  EXPECT_EQ(decoder->layout().axes[1].name, "slider_2");
}

TEST(ByDescriptor, ArraysOfButtonsPressTheButtonsThatTheyName) {
  // Two eight-bit elements that each name one of the buttons 1 to 12; 0 means none.
  const std::vector<std::uint8_t> descriptor = {0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x05, 0x09, 0x19, 0x01, 0x29, 0x0C,
                                                0x15, 0x01, 0x25, 0x0C, 0x75, 0x08, 0x95, 0x02, 0x81, 0x00, 0xC0};
  const auto decoder = make_by_descriptor(descriptor);
  ASSERT_NE(decoder, nullptr);
  EXPECT_EQ(decoder->layout().numbered.size(), 12U);
  RawPad pad;
  const std::vector<std::uint8_t> pressed = {3, 12};
  EXPECT_EQ(decoder->decode(pressed, pad), PadReport::state);
  EXPECT_EQ(pad.numbered.to_ulong(), (1UL << 2U) | (1UL << 11U));
  const std::vector<std::uint8_t> released = {12, 0};
  EXPECT_EQ(decoder->decode(released, pad), PadReport::state);
  EXPECT_EQ(pad.numbered.to_ulong(), 1UL << 11U);
}

//! Returns the left trigger at rest and after each report. The pad has the axes x, y, z, rz, rx and
//! ry of eight bits, with the minimum `minimum`; each report sets the trigger to one of `values`.
std::vector<float> triggers_after(std::uint8_t minimum, const std::vector<std::uint8_t>& values) {
  const std::vector<std::uint8_t> descriptor = {0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x09, 0x30, 0x09, 0x31,
                                                0x09, 0x32, 0x09, 0x35, 0x09, 0x33, 0x09, 0x34, 0x15, minimum,
                                                0x25, 0x7F, 0x75, 0x08, 0x95, 0x06, 0x81, 0x02, 0xC0};
  const auto decoder = make_by_descriptor(descriptor);
  RawPad raw = at_rest(decoder->layout());
  std::vector<float> read = {read_straight(decoder->layout(), raw).axis(PadAxis::left_trigger)};
  for (const std::uint8_t value : values) {
    decoder->decode(std::vector<std::uint8_t>{0, 0, 0, 0, value, 0}, raw);
    read.push_back(read_straight(decoder->layout(), raw).axis(PadAxis::left_trigger));
  }
  return read;
}

TEST(ByDescriptor, TriggersThatRestInTheMiddleOfTheirRangeAreNotHalfPressed) {
  EXPECT_THAT(triggers_after(0x81, {0, 127, 0, 0xFD, 3}),
              testing::Pointwise(testing::FloatNear(0.001F), {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 3.0F / 127.0F}));
  EXPECT_THAT(triggers_after(0x00, {64, 127, 60}),
              testing::Pointwise(testing::FloatNear(0.001F), {0.0F, 0.0F, 1.0F, 0.0F}));
}

TEST(ByDescriptor, TriggersThatRestAtTheirMinimumAreReadFromThere) {
  EXPECT_THAT(triggers_after(0x81, {0x81, 0, 127, 0x81}),
              testing::Pointwise(testing::FloatNear(0.001F), {0.0F, 0.0F, 0.5F, 1.0F, 0.0F}));
  EXPECT_THAT(triggers_after(0x00, {0, 64, 127}),
              testing::Pointwise(testing::FloatNear(0.005F), {0.0F, 0.0F, 0.504F, 1.0F}));
  // If a pad is plugged in while its trigger is pressed, or reports zero before its first
  // measurement, its true rest value is known only after the trigger is released.
  EXPECT_THAT(triggers_after(0x81, {0, 0x81, 0}),
              testing::Pointwise(testing::FloatNear(0.001F), {0.0F, 0.0F, 0.0F, 0.5F}));
}

TEST(ByDescriptor, RelativeAxesOfAPadHaveNoPosition) {
  std::vector<std::uint8_t> descriptor = {0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x09, 0x30, 0x09, 0x38, 0x15,
                                          0x81, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xC0};
  EXPECT_EQ(make_by_descriptor(descriptor), nullptr);
  descriptor[19] = 0x02;
  EXPECT_EQ(make_by_descriptor(descriptor)->layout().axes.size(), 2U);
}

TEST(ByDescriptor, AxesAndButtonsGoWhereTheProfileSays) {
  const FixtureDevice stick = fixture("saitek_x52").devices.front();
  const auto decoder = make_by_descriptor(stick.descriptor);
  PadProfile profile = straight_profile();
  profile.axes["z"] = {PadAxis::right_trigger, true};
  profile.axes["rz"] = {PadAxis::turn_yaw, false};
  profile.axes["x"] = {std::nullopt, false};
  profile.buttons = {PadButton::guide, std::nullopt};
  RawPad raw = at_rest(decoder->layout());
  // The report has x, y and twist at their maximum (all 32 bits set), the throttle at 0, and the
  // first two buttons pressed.
  std::vector<std::uint8_t> report(14);
  std::fill_n(report.begin(), 4, 0xFF);
  report[8] = 0x03;
  ASSERT_EQ(decoder->decode(report, raw), PadReport::state);
  const PadState state = PadResponse(decoder->layout(), profile).apply(raw, {}, {});
  EXPECT_FLOAT_EQ(state.axis(PadAxis::left_x), 0.0F);
  EXPECT_FLOAT_EQ(state.axis(PadAxis::right_x), 0.0F);
  EXPECT_FLOAT_EQ(state.axis(PadAxis::turn_yaw), 1.0F);
  EXPECT_FLOAT_EQ(state.axis(PadAxis::right_trigger), 1.0F);
  EXPECT_EQ(pressed(state), (std::vector<std::string>{"right_trigger", "guide"}));
}

}  // namespace
}  // namespace ergodome::test
