#include "app/pads/hid/hid_descriptor.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t longest_descriptor = 4096;
constexpr std::uint32_t longest_report_bits = 65'536U * 8U;
constexpr std::uint32_t widest_field = 32;
constexpr std::size_t deepest = 32;
//! Maximum number of fields that one input item may add; a range of usages may name 65,536.
constexpr std::uint32_t max_fields_of_item = 256;
constexpr std::size_t max_fields = 2048;

//! Type and tag of an item, in the upper six bits of its first byte; the lower two are its size.
enum Item : unsigned {
  input = 0x80,
  output = 0x90,
  feature = 0xB0,
  collection = 0xA0,
  end_collection = 0xC0,
  usage_page = 0x04,
  logical_minimum = 0x14,
  logical_maximum = 0x24,
  report_size = 0x74,
  report_id = 0x84,
  report_count = 0x94,
  push = 0xA4,
  pop = 0xB4,
  usage = 0x08,
  usage_minimum = 0x18,
  usage_maximum = 0x28
};
constexpr unsigned long_item = 0xFE;
constexpr unsigned application_collection = 0x01;
constexpr unsigned is_constant = 0x01;
constexpr unsigned is_variable = 0x02;
constexpr unsigned is_relative = 0x04;

struct UsageRange {
  std::uint32_t first = 0;  //!< usage: page in the upper 16 bits, number in the lower
  std::uint32_t last = 0;
  //! True if the descriptor gives page and number together; pages that it sets later then do not
  //! apply.
  bool has_own_page = false;
};

struct Globals {
  std::uint16_t page = 0;
  std::uint32_t min_bits = 0;  //!< logical minimum as stored in the descriptor, without sign extension
  std::size_t min_size = 0;
  std::uint32_t max_bits = 0;
  std::size_t max_size = 0;
  std::uint32_t size = 0;
  std::uint32_t count = 0;
  std::uint8_t id = 0;
};

std::int64_t as_signed(std::uint32_t bits, std::size_t size) {
  switch (size) {
    case 1:
      return static_cast<std::int8_t>(bits);
    case 2:
      return static_cast<std::int16_t>(bits);
    default:
      return static_cast<std::int32_t>(bits);
  }
}

class Parser {
 public:
  explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  HidLayout parse() {
    if (bytes_.size() > longest_descriptor) {
      throw problem("is longer than 4096 bytes");
    }
    while (at_ < bytes_.size()) {
      take_item();
    }
    if (layout_.has_ids) {
      std::erase_if(layout_.fields, [](const HidField& field) { return field.report_id == 0; });
      layout_.report_bits.erase(0);
    }
    return std::move(layout_);
  }

 private:
  [[nodiscard]] Error problem(const std::string& what) const {
    return {"report descriptor", fmt::format("byte {}: {}", at_, what), "this controller cannot be used"};
  }

  //! Reads an item: size, type and tag, then up to four bytes, low byte first.
  void take_item() {
    const unsigned head = bytes_[at_];
    if (head == long_item) {
      const std::size_t length = at_ + 1 < bytes_.size() ? 3U + bytes_[at_ + 1] : bytes_.size() + 1;
      skip(length);
      return;
    }
    const std::size_t size = (head & 3U) == 3U ? 4U : (head & 3U);
    const std::size_t start = at_ + 1;
    if (start + size > bytes_.size()) {
      throw problem("ends in the middle of an item");
    }
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value |= static_cast<std::uint32_t>(bytes_[start + i]) << (8U * i);
    }
    interpret(head & 0xFCU, value, size);
    at_ = start + size;
  }

  void skip(std::size_t length) {
    if (length > bytes_.size() - at_) {
      throw problem("ends in the middle of a long item");
    }
    at_ += length;
  }

  void interpret(unsigned item, std::uint32_t value, std::size_t size) {
    switch (item) {
      case Item::input:
        complete_usages();
        take_input(value);
        break;
      case Item::collection:
        complete_usages();
        begin_collection(value);
        break;
      case Item::end_collection:
        if (depth_ == 0) {
          throw problem("ends a collection that was not opened");
        }
        --depth_;
        break;
      case Item::usage:
        add_usages(full(value, size), full(value, size));
        return;
      case Item::usage_minimum:
        range_first_ = full(value, size);
        return;
      case Item::usage_maximum:
        add_usages(range_first_, full(value, size));
        return;
      default:
        if ((item & 0x0CU) == 0x04U) {
          take_global(item, value, size);
        }
        if ((item & 0x0CU) != 0x00U) {
          return;  // global items, and local items that are not used
        }
    }
    // Local items apply to one main item, so they are cleared after it.
    usages_.clear();
    range_first_ = 0;
  }

  void take_global(unsigned item, std::uint32_t value, std::size_t size) {
    switch (item) {
      case Item::usage_page:
        globals_.page = static_cast<std::uint16_t>(value);
        break;
      case Item::logical_minimum:
        globals_.min_bits = value;
        globals_.min_size = size;
        break;
      case Item::logical_maximum:
        globals_.max_bits = value;
        globals_.max_size = size;
        break;
      case Item::report_size:
        globals_.size = value;
        break;
      case Item::report_count:
        globals_.count = value;
        break;
      case Item::report_id:
        if (value == 0 || value > 255) {
          throw problem("has an invalid report id (1 to 255 are valid)");
        }
        globals_.id = static_cast<std::uint8_t>(value);
        layout_.has_ids = true;
        break;
      case Item::push:
        if (stack_.size() >= deepest) {
          throw problem("has too many Push items");
        }
        stack_.push_back(globals_);
        break;
      case Item::pop:
        if (stack_.empty()) {
          throw problem("has a Pop item without a Push item");
        }
        globals_ = stack_.back();
        stack_.pop_back();
        break;
      default:
        break;
    }
  }

  //! Returns a usage with its page: four-byte usages have it in the upper two bytes.
  static std::uint32_t full(std::uint32_t value, std::size_t size) { return size == 4 ? value : value & 0xFFFFU; }

  static constexpr std::uint32_t page_shift = 16;

  [[nodiscard]] std::uint32_t with_page(std::uint32_t usage) const {
    return usage >> page_shift != 0 ? usage : usage | std::uint32_t{globals_.page} << page_shift;
  }

  void add_usages(std::uint32_t first, std::uint32_t last) {
    const bool has_own_page = last >> page_shift != 0;
    if (with_page(last) >= with_page(first) && usages_.size() < max_fields_of_item) {
      usages_.push_back({with_page(first), with_page(last), has_own_page});
    }
  }

  //! Gives the last usages the page of the main item, if that page was set after them (HID 1.11,
  //! 6.2.2.8). Usages before the last one with that page keep the pages at the time they were
  //! named, as in Linux: some controllers change the page within an item.
  void complete_usages() {
    for (auto range = usages_.rbegin(); range != usages_.rend(); ++range) {
      if (range->has_own_page) {
        continue;
      }
      if (range->last >> page_shift == globals_.page) {
        return;
      }
      const std::uint32_t page = std::uint32_t{globals_.page} << page_shift;
      *range = {(range->first & 0xFFFFU) | page, (range->last & 0xFFFFU) | page, false};
    }
  }

  [[nodiscard]] static HidUsage usage_of(std::uint32_t value) {
    return {static_cast<std::uint16_t>(value >> page_shift), static_cast<std::uint16_t>(value)};
  }

  void begin_collection(std::uint32_t kind) {
    if (depth_ >= deepest) {
      throw problem("nests collections too deeply");
    }
    ++depth_;
    if (kind == application_collection && !usages_.empty()) {
      layout_.applications.push_back(usage_of(usages_.front().first));
    }
  }

  void take_input(std::uint32_t flags) {
    if (globals_.size > widest_field) {
      throw problem("has an input of more than 32 bits");
    }
    std::uint32_t& length = layout_.report_bits[globals_.id];
    const std::uint64_t bits = static_cast<std::uint64_t>(globals_.size) * globals_.count;
    if (length + bits > longest_report_bits) {
      throw problem("has a report of more than 64 KiB");
    }
    if ((flags & is_constant) == 0 && globals_.size > 0) {
      if ((flags & is_variable) != 0) {
        add_fields(length, (flags & is_relative) != 0);
      } else {
        add_array(length);
      }
    }
    length += static_cast<std::uint32_t>(bits);
  }

  //! Adds one field for each usage within the limits. Values beyond the last usage repeat it and
  //! are skipped.
  void add_fields(std::uint32_t offset, bool relative) {
    HidField field = field_of_globals();
    field.is_relative = relative;
    std::uint32_t taken = 0;
    for (const UsageRange& range : usages_) {
      for (std::uint32_t value = range.first; taken < std::min(globals_.count, max_fields_of_item); ++value) {
        field.usage = usage_of(value);
        field.bit_offset = offset + taken * globals_.size;
        ++taken;
        if (layout_.fields.size() < max_fields) {
          layout_.fields.push_back(field);
        }
        if (value == range.last) {
          break;
        }
      }
    }
  }

  //! Adds the elements of an array, each of which selects one usage of a range (HID 1.11, 6.2.2.5).
  //! Skips lists of single usages, which no controller uses for buttons.
  void add_array(std::uint32_t offset) {
    if (usages_.size() != 1 || usages_.front().first == usages_.front().last) {
      return;
    }
    HidField field = field_of_globals();
    field.is_array = true;
    field.usage = usage_of(usages_.front().first);
    field.maximum = std::min(field.maximum, field.minimum + (usages_.front().last - usages_.front().first));
    for (std::uint32_t i = 0; i < std::min(globals_.count, max_fields_of_item); ++i) {
      field.bit_offset = offset + i * globals_.size;
      if (layout_.fields.size() < max_fields) {
        layout_.fields.push_back(field);
      }
    }
  }

  [[nodiscard]] HidField field_of_globals() const {
    HidField field;
    field.report_id = globals_.id;
    field.bits = static_cast<std::uint8_t>(globals_.size);
    set_range(field);
    return field;
  }

  //! Sets the logical range. Limits are signed, according to their size; but many devices store 255
  //! in one byte with a minimum of 0. Corrects limits that are swapped, missing, or beyond the
  //! range of the field's bits.
  void set_range(HidField& field) const {
    field.minimum = as_signed(globals_.min_bits, globals_.min_size);
    field.maximum = as_signed(globals_.max_bits, globals_.max_size);
    if (field.minimum >= 0 && field.maximum < field.minimum) {
      field.maximum = globals_.max_bits;
    } else if (field.minimum == -1 && field.maximum == 0) {
      // A minimum with all bits set and a maximum of 0 mean the whole unsigned range, with its
      // limits swapped.
      field.minimum = globals_.min_bits;
    }
    if (field.maximum < field.minimum) {
      std::swap(field.minimum, field.maximum);
    }
    const std::int64_t values = std::int64_t{1} << field.bits;
    const std::int64_t lowest = field.minimum < 0 ? -values / 2 : 0;
    const std::int64_t highest = lowest + values - 1;
    field.minimum = std::clamp(field.minimum, lowest, highest);
    field.maximum = std::clamp(field.maximum, lowest, highest);
    if (field.maximum == field.minimum) {
      field.minimum = lowest;
      field.maximum = highest;
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
  Globals globals_;
  std::vector<Globals> stack_;
  std::vector<UsageRange> usages_;
  std::uint32_t range_first_ = 0;
  HidLayout layout_;
};

}  // namespace

HidLayout parse_hid_descriptor(std::span<const std::uint8_t> descriptor) { return Parser(descriptor).parse(); }

std::int64_t field_value(const HidField& field, std::span<const std::uint8_t> data) {
  const std::size_t first = field.bit_offset / 8U;
  const unsigned shift = field.bit_offset % 8U;
  const std::size_t last = (field.bit_offset + field.bits + 7U) / 8U;
  std::uint64_t bits = 0;
  for (std::size_t i = first; i < std::min(last, data.size()); ++i) {
    bits |= static_cast<std::uint64_t>(data[i]) << (8U * (i - first));
  }
  const std::uint64_t value = (bits >> shift) & ((std::uint64_t{1} << field.bits) - 1U);
  const bool negative = field.minimum < 0 && ((value >> (field.bits - 1U)) & 1U) != 0;
  return negative ? static_cast<std::int64_t>(value) - (std::int64_t{1} << field.bits)
                  : static_cast<std::int64_t>(value);
}

}  // namespace ergodome
