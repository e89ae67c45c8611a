#include "app/pads/hid/hid_descriptor.h"

#include <gmock/gmock.h>

#include "app/pads/decoders/decoders.h"
#include "tests/app/pads/fixtures.h"
#include "tests/support/errors.h"

namespace ergodome::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;

HidLayout layout_of(const std::string& name) { return parse_hid_descriptor(fixture(name).devices.front().descriptor); }

const HidField& field_of(const HidLayout& layout, HidUsage usage) {
  static const HidField none;
  for (const HidField& field : layout.fields) {
    if (field.usage == usage) {
      return field;
    }
  }
  ADD_FAILURE() << "no usage " << usage.page << ':' << usage.usage;
  return none;
}

//! Returns the descriptor of a joystick that contains the given items.
Bytes joystick(const Bytes& items) {
  Bytes all = {0x05, 0x01, 0x09, 0x04, 0xA1, 0x01};
  all.insert(all.end(), items.begin(), items.end());
  all.push_back(0xC0);
  return all;
}

std::string problem_of(const Bytes& descriptor) {
  return error_of([&] { parse_hid_descriptor(descriptor); });
}

TEST(HidDescriptor, PlacesFieldsThatAreNotAlignedAsTheStickDoes) {
  // The published layout of the X52, with the number of bits in each field: x 11, y 11, twist 10,
  // four axes of 8, 34 buttons, 2 bits of padding, hat 4.
  const HidLayout layout = layout_of("saitek_x52");
  EXPECT_FALSE(layout.has_ids);
  EXPECT_EQ(layout.report_bits.at(0), 14U * 8U);
  EXPECT_EQ(field_of(layout, {1, 0x30}).bit_offset, 0U);
  EXPECT_EQ(field_of(layout, {1, 0x31}).bit_offset, 11U);
  EXPECT_EQ(field_of(layout, {1, 0x31}).maximum, 2047);
  EXPECT_EQ(field_of(layout, {1, 0x35}).bit_offset, 22U);
  EXPECT_EQ(field_of(layout, {1, 0x35}).bits, 10);
  EXPECT_EQ(field_of(layout, {9, 1}).bit_offset, 64U);
  EXPECT_EQ(field_of(layout, {9, 34}).bit_offset, 97U);
  EXPECT_EQ(field_of(layout, {1, 0x39}).bit_offset, 100U);
  EXPECT_EQ(field_of(layout, {1, 0x39}).minimum, 1);
}

//! Returns the x axis of a joystick with the given logical limits, in a field of `bits` bits.
HidField axis_of(const Bytes& limits, std::uint8_t bits) {
  Bytes items = {0x09, 0x30};
  items.insert(items.end(), limits.begin(), limits.end());
  items.insert(items.end(), {0x75, bits, 0x95, 0x01, 0x81, 0x02});
  return field_of(parse_hid_descriptor(joystick(items)), {1, 0x30});
}

TEST(HidDescriptor, CorrectsLimitsThatAFieldCannotHold) {
  struct Case {
    Bytes limits;
    std::uint8_t bits;
    std::int64_t minimum;
    std::int64_t maximum;
  };
  for (const Case& each : {Case{{0x15, 0x00, 0x25, 0xFF}, 8, 0, 255},                        // 255 in one signed byte
                           Case{{0x15, 0x20, 0x27, 0xFF, 0xFF, 0x20, 0x20}, 16, 32, 65535},  // maximum too large
                           Case{{0x15, 0x80, 0x26, 0xFF, 0x7F}, 8, -128, 127},               // signed, also too large
                           Case{{0x26, 0xFF, 0x03, 0x15, 0x00}, 10, 0, 1023},
                           Case{{0x16, 0xFF, 0x03, 0x25, 0x00}, 10, 0, 1023},  // limits swapped
                           Case{{0x15, 0xFF, 0x25, 0x00}, 8, 0, 255},          // limits swapped, in one byte
                           Case{{}, 12, 0, 4095}}) {                           // limits missing
    const HidField field = axis_of(each.limits, each.bits);
    EXPECT_EQ(field.minimum, each.minimum) << int(each.bits);
    EXPECT_EQ(field.maximum, each.maximum) << int(each.bits);
  }
}

TEST(HidDescriptor, TakesUsagesOfFourBytesWithTheirPage) {
  const HidLayout layout = layout_of("switch_pro_usb");
  EXPECT_TRUE(layout.has_ids);
  EXPECT_EQ(layout.report_bits.at(0x30), 63U * 8U);
  EXPECT_EQ(layout.report_bits.at(0x21), 63U * 8U);
  EXPECT_EQ(layout.report_bits.at(0x81), 63U * 8U);
  EXPECT_EQ(field_of(layout, {1, 0x30}).bit_offset, 16U);
  EXPECT_EQ(field_of(layout, {1, 0x35}).maximum, 65535);
  EXPECT_EQ(field_of(layout, {1, 0x39}).bit_offset, 80U);
  EXPECT_EQ(field_of(layout, {9, 18}).bit_offset, 87U);
}

TEST(HidDescriptor, CountsEachReportIdByItself) {
  const HidLayout layout = layout_of("space_navigator");
  EXPECT_EQ(layout.applications, std::vector<HidUsage>(1, {1, 8}));
  EXPECT_EQ(layout.report_bits.at(1), 48U);
  EXPECT_EQ(layout.report_bits.at(2), 48U);
  EXPECT_EQ(layout.report_bits.at(3), 16U);
  EXPECT_EQ(field_of(layout, {1, 0x34}).report_id, 2);
  EXPECT_EQ(field_of(layout, {1, 0x34}).bit_offset, 16U);
  EXPECT_EQ(field_of(layout, {1, 0x34}).minimum, -350);
}

TEST(HidDescriptor, TellsReportsOfBluetoothApart) {
  const HidLayout sense = layout_of("dualsense_bluetooth");
  EXPECT_EQ(sense.report_bits.at(0x01), 9U * 8U);
  EXPECT_EQ(sense.report_bits.at(0x31), 77U * 8U);
  const HidLayout xbox = layout_of("xbox_series");
  EXPECT_EQ(xbox.report_bits.at(1), 16U * 8U);
  EXPECT_EQ(field_of(xbox, {2, 0xC4}).bit_offset, 80U);
  EXPECT_EQ(field_of(xbox, {2, 0xC4}).maximum, 1023);
}

TEST(HidDescriptor, SaysWhatIsNoPad) {
  const HidFixture others = fixture("mouse_and_keyboard");
  EXPECT_EQ(parse_hid_descriptor(others.devices[0].descriptor).applications, std::vector<HidUsage>(1, {1, 2}));
  EXPECT_EQ(parse_hid_descriptor(others.devices[1].descriptor).applications, std::vector<HidUsage>(1, {1, 6}));
}

TEST(HidDescriptor, PopsWhatWasPushed) {
  // Items of the descriptor: fields of eight bits from 0 to 255; Push; a button of one bit; Pop,
  // which restores the eight bits; the x axis.
  const HidLayout layout =
      parse_hid_descriptor(joystick({0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x01, 0xA4, 0x05, 0x09, 0x25, 0x01,
                                     0x75, 0x01, 0x19, 0x01, 0x29, 0x01, 0x81, 0x02, 0xB4, 0x09, 0x30, 0x81, 0x02}));
  const HidField& x = field_of(layout, {1, 0x30});
  EXPECT_EQ(x.bit_offset, 1U);
  EXPECT_EQ(x.bits, 8);
  EXPECT_EQ(x.maximum, 255);
}

TEST(HidDescriptor, UsagesTakeThePageThatIsSetBehindThemAndKeepOneThatChangesBetweenThem) {
  // Usages x and y are followed by their usage page, which applies to them (HID 1.11, 6.2.2.8).
  const HidLayout behind = parse_hid_descriptor(joystick(
      {0x05, 0x0C, 0x09, 0x30, 0x09, 0x31, 0x05, 0x01, 0x15, 0x00, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x02, 0x81, 0x02}));
  EXPECT_EQ(field_of(behind, {1, 0x30}).bit_offset, 0U);
  EXPECT_EQ(field_of(behind, {1, 0x31}).bit_offset, 8U);
  // Three usages: x on the generic desktop page, the accelerator on the simulation page, and one
  // whose item contains its usage page.
  const HidLayout between =
      parse_hid_descriptor(joystick({0x09, 0x30, 0x05, 0x02, 0x09, 0xC4, 0x0B, 0x32, 0x00, 0x01, 0x00,
                                     0x15, 0x00, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x03, 0x81, 0x02}));
  EXPECT_EQ(field_of(between, {1, 0x30}).bit_offset, 0U);
  EXPECT_EQ(field_of(between, {2, 0xC4}).bit_offset, 8U);
  EXPECT_EQ(field_of(between, {1, 0x32}).bit_offset, 16U);
}

TEST(HidDescriptor, ReadsSignedNumbersOfAnyWidth) {
  // The report has 3 bits of padding, then the x axis with 12 bits from -2048 to 2047.
  const HidLayout layout = parse_hid_descriptor(joystick(
      {0x75, 0x03, 0x95, 0x01, 0x81, 0x03, 0x16, 0x00, 0xF8, 0x26, 0xFF, 0x07, 0x75, 0x0C, 0x09, 0x30, 0x81, 0x02}));
  const HidField& x = field_of(layout, {1, 0x30});
  ASSERT_EQ(x.bit_offset, 3U);
  const auto value_of = [&](int number) {
    const auto bits = static_cast<std::uint16_t>((static_cast<unsigned>(number) & 0xFFFU) << 3U);
    return field_value(x, Bytes{static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U)});
  };
  for (const int number : {-2048, -1, 0, 1, 2047}) {
    EXPECT_EQ(value_of(number), number);
  }
}

TEST(HidDescriptor, ReadsThirtyTwoBitsAcrossFiveBytes) {
  HidField field;
  field.bit_offset = 7;
  field.bits = 32;
  field.minimum = 0;
  EXPECT_EQ(field_value(field, Bytes{0x80, 0xFF, 0xFF, 0xFF, 0x7F}), 0xFFFFFFFFLL);
  field.minimum = -1;
  EXPECT_EQ(field_value(field, Bytes{0x80, 0xFF, 0xFF, 0xFF, 0x7F}), -1);
}

TEST(HidDescriptor, TakesAByteOf255BesideAMinimumOf0AsMeant) {
  const HidLayout layout =
      parse_hid_descriptor(joystick({0x15, 0x00, 0x25, 0xFF, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}));
  EXPECT_EQ(field_of(layout, {1, 0x30}).maximum, 255);
}

TEST(HidDescriptor, PassesOverLongItemsArraysAndOutputs) {
  const HidLayout layout =
      parse_hid_descriptor(joystick({0xFE, 0x02, 0x10, 0xAA, 0xBB, 0x15, 0x00, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x01,
                                     0x09, 0x31, 0x81, 0x00, 0x09, 0x32, 0x91, 0x02, 0x09, 0x30, 0x81, 0x02}));
  ASSERT_EQ(layout.fields.size(), 1U);
  EXPECT_EQ(layout.fields[0].usage, (HidUsage{1, 0x30}));
  EXPECT_EQ(layout.fields[0].bit_offset, 8U);
}

TEST(HidDescriptor, HatsOfFourDirectionsPointAsThoseOfEight) {
  // A hat switch with a field of four bits and values from 0 to 3.
  const auto decoder = make_by_descriptor(
      joystick({0x15, 0x00, 0x25, 0x03, 0x75, 0x04, 0x95, 0x01, 0x09, 0x39, 0x81, 0x42, 0x81, 0x03}));
  ASSERT_NE(decoder, nullptr);
  const std::vector<PadButton> directions = {PadButton::dpad_up, PadButton::dpad_right, PadButton::dpad_down,
                                             PadButton::dpad_left};
  for (std::uint8_t i = 0; i < 16; ++i) {
    RawPad raw;
    decoder->decode(Bytes{i}, raw);
    std::bitset<pad_button_count> wanted;
    if (i < 4) {
      wanted.set(static_cast<std::size_t>(directions[i]));
    }
    EXPECT_EQ(raw.buttons, wanted) << int(i);
  }
}

TEST(HidDescriptor, IsRefusedWhereItIsLongerThan4096Bytes) {
  EXPECT_THAT(problem_of(Bytes(4097, 0xC0)), HasSubstr("longer than 4096 bytes"));
}

TEST(HidDescriptor, IsRefusedWhereAnInputHasMoreThan32Bits) {
  EXPECT_THAT(problem_of(joystick({0x75, 0x21, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02})), HasSubstr("more than 32 bits"));
}

TEST(HidDescriptor, IsRefusedWhereAReportHasMoreThan64KiB) {
  const Bytes half = {0x75, 0x08, 0x97, 0x00, 0x80, 0x00, 0x00, 0x81, 0x03};
  Bytes items = half;
  items.insert(items.end(), half.begin(), half.end());
  EXPECT_EQ(problem_of(joystick(items)), "");
  items.insert(items.end(), {0x95, 0x01, 0x81, 0x03});
  EXPECT_THAT(problem_of(joystick(items)), HasSubstr("more than 64 KiB"));
}

TEST(HidDescriptor, IsRefusedWhereCountAndSizeOverflow) {
  EXPECT_THAT(problem_of(joystick({0x75, 0x20, 0x97, 0xFF, 0xFF, 0xFF, 0xFF, 0x81, 0x02})),
              HasSubstr("more than 64 KiB"));
}

TEST(HidDescriptor, IsRefusedWhereItEndsInTheMiddleOfAnItem) {
  EXPECT_THAT(problem_of({0x05, 0x01, 0x27, 0xFF, 0xFF}), HasSubstr("middle of an item"));
  EXPECT_THAT(problem_of({0x05, 0x01, 0xFE, 0x05, 0x10, 0x00}), HasSubstr("middle of a long item"));
}

TEST(HidDescriptor, IsRefusedWhereItNestsOrPopsBeyondReason) {
  EXPECT_THAT(problem_of({0xC0}), HasSubstr("was not opened"));
  EXPECT_THAT(problem_of({0xB4}), HasSubstr("without a Push item"));
  EXPECT_THAT(problem_of(Bytes(100, 0xA4)), HasSubstr("too many Push items"));
  EXPECT_THAT(problem_of(Bytes(100, 0xA0)), HasSubstr("too deeply"));
  EXPECT_THAT(problem_of({0x85, 0x00}), HasSubstr("report id"));
}

TEST(HidDescriptor, OfAllUsagesThereAreStaysSmall) {
  // The descriptor repeats this block: all usages from 0 to 65535, for 65,535 fields of one bit.
  Bytes items;
  for (int i = 0; i < 8; ++i) {
    const Bytes block = {0x1A, 0x00, 0x00, 0x2A, 0xFF, 0xFF, 0x75, 0x01, 0x96, 0xFF, 0xFF, 0x81, 0x02};
    items.insert(items.end(), block.begin(), block.end());
  }
  EXPECT_LE(parse_hid_descriptor(joystick(items)).fields.size(), 2048U);
}

}  // namespace
}  // namespace ergodome::test
