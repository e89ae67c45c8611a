#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "app/pads/hid/hid_api.h"

namespace ergodome {

//! One number of an input report: where it stands, what it means, and from where to where it goes.
struct HidField {
  std::uint8_t report_id = 0;    //!< 0: the device has no ids
  std::uint32_t bit_offset = 0;  //!< from the report's first bit, behind the id
  std::uint8_t bits = 0;         //!< 1 to 32
  HidUsage usage;                //!< of an array: the usage that stands for `least`
  std::int64_t least = 0;        //!< logical; beyond it the field is null
  std::int64_t greatest = 0;
  bool is_array = false;     //!< its value selects a usage: that of `least`, or one of those that follow it
  bool is_relative = false;  //!< its value is a change since the last report
};

//! What a report descriptor says of input (USB Device Class Definition for HID 1.11, chapter 6.2.2).
struct HidLayout {
  bool has_ids = false;
  std::vector<HidUsage> applications;  //!< what the device is, once for each application collection
  std::vector<HidField> fields;        //!< variables with a usage, arrays with a range of usages; no constants
  std::map<std::uint8_t, std::uint32_t> report_bits;  //!< length of each input report, without the id
};

//! Reads a report descriptor. Throws Error where it is longer than 4096 bytes, ends in the middle of an item, has an input of more than
//! 32 bits, a report of more than 64 KiB, or nests beyond reason. What it says of output and features is passed over.
HidLayout parse_hid_descriptor(std::span<const std::uint8_t> descriptor);

//! A field's number of a report; `data` begins behind the id and is as long as report_bits says. Signed where `least` is below 0.
std::int64_t field_value(const HidField& field, std::span<const std::uint8_t> data);

}  // namespace ergodome
