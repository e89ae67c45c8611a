#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "app/pads/hid/hid_api.h"

namespace ergodome {

//! A number in an input report: its position, meaning and range.
struct HidField {
  std::uint8_t report_id = 0;    //!< 0: the device has no ids
  std::uint32_t bit_offset = 0;  //!< from the report's first bit, after the id
  std::uint8_t bits = 0;         //!< number of bits, 1 to 32
  HidUsage usage;                //!< for an array: the usage of value `minimum`
  //! Logical minimum. A value outside [minimum, maximum] means that the field has no value.
  std::int64_t minimum = 0;
  std::int64_t maximum = 0;
  bool is_array = false;     //!< its value selects a usage: that of `minimum`, or a later one
  bool is_relative = false;  //!< the value is a change since the last report
};

//! The input part of a report descriptor (USB Device Class Definition for HID 1.11, chapter 6.2.2).
struct HidLayout {
  bool has_ids = false;
  std::vector<HidUsage> applications;  //!< kinds of the device, one per application collection
  //! Variables with a usage, arrays with a range of usages; no constants.
  std::vector<HidField> fields;
  //! Length of each input report without the id [bits], by report id.
  std::map<std::uint8_t, std::uint32_t> report_bits;
};

//! Parses a report descriptor; ignores outputs and features. Throws Error if it is malformed,
//! longer than 4096 bytes or nested too deeply, or has an input of more than 32 bits or a report of
//! more than 64 KiB.
HidLayout parse_hid_descriptor(std::span<const std::uint8_t> descriptor);

//! Returns the value of a field in a report; signed if `minimum` is negative. `data` starts after
//! the id and is as long as given by report_bits.
std::int64_t field_value(const HidField& field, std::span<const std::uint8_t> data);

}  // namespace ergodome
