#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/generic_mapping.h"
#include "app/pads/hid/hid_descriptor.h"
#include "app/pads/state/pad_names.h"

namespace ergodome {

namespace {

//! A field to read from a report, and the target of its value.
struct Read {
  HidField field;
  enum class As { axis, hat, numbered_button, button_array, button } as = As::axis;
  //! By `as`: index of the raw axis, index of the numbered button (from 0), number of the array's
  //! first button (from 1), or the PadButton; unused for a hat.
  std::size_t index = 0;
};

//! Determines where a trigger rests, which descriptors do not state: at its minimum, or in the
//! middle of its range like a stick. Assumes the middle until a value well below it is reported.
class TriggerRest {
 public:
  explicit TriggerRest(const RawAxis& range) : minimum_(range.minimum), middle_(range.centre) {}

  //! Takes a reported value, and sets rest position and minimum of the axis to where the trigger
  //! rests. Returns whether they changed.
  bool take(std::int32_t value, RawAxis& axis) {
    // Rest positions may deviate from the middle by an eighth of the whole range.
    const std::int64_t below = std::int64_t{middle_} - value;
    rests_at_least_ = rests_at_least_ || 4 * below > std::int64_t{middle_} - minimum_;
    axis.centre = rests_at_least_ ? minimum_ : middle_;
    return std::exchange(axis.minimum, axis.centre) != axis.centre;
  }

 private:
  std::int32_t minimum_;
  std::int32_t middle_;
  bool rests_at_least_ = false;
};

constexpr std::uint16_t desktop = 0x01;
constexpr std::uint16_t buttons = 0x09;

class ByDescriptor : public PadDecoder {
 public:
  explicit ByDescriptor(const HidLayout& hid) : has_ids_(hid.has_ids), report_bits_(hid.report_bits) {
    std::size_t button_count = 0;
    is_puck_ = is_puck(hid);
    for (const HidField& field : hid.fields) {
      add(field);
      if (field.usage.page == buttons) {
        const std::int64_t more = field.is_array ? field.maximum - field.minimum : 0;
        button_count = std::max(button_count, static_cast<std::size_t>(field.usage.usage + more));
      }
    }
    map_generic_axes(hid, layout_.axes);
    for (std::size_t i = 0; i < layout_.axes.size(); ++i) {
      RawAxis& axis = layout_.axes[i];
      if (axis.axis && is_trigger(*axis.axis)) {
        triggers_.emplace(i, TriggerRest(axis));
        axis.centre = axis.minimum;
      }
    }
    layout_.numbered = generic_buttons(hid, std::min(button_count, max_numbered_buttons));
  }

  [[nodiscard]] bool reads_anything() const { return !reads_.empty(); }
  [[nodiscard]] std::string_view model() const override { return "described by its report descriptor"; }
  [[nodiscard]] const RawLayout& layout() const override { return layout_; }

  PadReport decode(ReportBytes report, RawPad& pad) override {
    const std::size_t start = has_ids_ ? 1 : 0;
    if (report.size() <= start) {
      return PadReport::refused;
    }
    const std::uint8_t id = has_ids_ ? report[0] : 0;
    const auto bits = report_bits_.find(id);
    // Some devices pad their reports, so a report may be longer than described, but not shorter.
    if (bits == report_bits_.end() || (report.size() - start) * 8 < bits->second) {
      return PadReport::refused;
    }
    bool is_state = false;
    bool ranges_change = false;
    const ReportBytes data = report.subspan(start);
    for (const Read& read : reads_) {
      if (read.field.report_id == id) {
        if (!is_state) {
          release_buttons(id, pad);
        }
        is_state = true;
        take(read, field_value(read.field, data), pad);
        ranges_change = find_rest(read, pad) || ranges_change;
      }
    }
    return ranges_change ? PadReport::changed : is_state ? PadReport::state : PadReport::other;
  }

 private:
  //! If the value is that of a trigger, uses it to find the trigger's rest position. Returns
  //! whether the range of the axis changed.
  bool find_rest(const Read& read, const RawPad& pad) {
    const auto trigger = read.as == Read::As::axis ? triggers_.find(read.index) : triggers_.end();
    return trigger != triggers_.end() && trigger->second.take(pad.values[read.index], layout_.axes[read.index]);
  }

  void add(const HidField& field) {
    if (field.is_array) {
      if (field.usage.page == buttons) {
        reads_.push_back({field, Read::As::button_array, field.usage.usage});
      }
    } else if (const char* const name = generic_axis_name(field.usage); name != nullptr) {
      // Relative axes report changes, not positions. 3D mice are an exception: they mark positions
      // as relative.
      if (!field.is_relative || is_puck_) {
        add_axis(field, name);
      }
    } else if (field.usage == HidUsage{desktop, 0x39}) {
      reads_.push_back({field, Read::As::hat, 0});
    } else if (field.usage.page == buttons && field.usage.usage >= 1 && field.usage.usage <= max_numbered_buttons) {
      reads_.push_back({field, Read::As::numbered_button, field.usage.usage - 1U});
    } else if (const auto button = generic_button(field.usage)) {
      reads_.push_back({field, Read::As::button, static_cast<std::size_t>(*button)});
    }
  }

  void add_axis(const HidField& field, const std::string& name) {
    const auto inside = [](std::int64_t value) {
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, std::numeric_limits<std::int32_t>::min(),
                                                                std::numeric_limits<std::int32_t>::max()));
    };
    if (layout_.axes.size() >= max_raw_axes || field.maximum <= field.minimum) {
      return;
    }
    reads_.push_back({field, Read::As::axis, layout_.axes.size()});
    layout_.axes.push_back({unused_name(name), inside(field.minimum), inside((field.minimum + field.maximum + 1) / 2),
                            inside(field.maximum), std::nullopt, false});
  }

  //! Returns a free name: "slider", then "slider_2".
  [[nodiscard]] std::string unused_name(const std::string& name) const {
    std::string candidate = name;
    const auto is_taken = [&](const RawAxis& axis) { return axis.name == candidate; };
    for (int i = 2; std::any_of(layout_.axes.begin(), layout_.axes.end(), is_taken); ++i) {
      candidate = name;
      candidate += '_';
      candidate += std::to_string(i);
    }
    return candidate;
  }

  //! Releases the buttons of this report; keeps those of other reports.
  void release_buttons(std::uint8_t id, RawPad& pad) const {
    for (const Read& read : reads_) {
      if (read.field.report_id != id) {
        continue;
      }
      if (read.as == Read::As::numbered_button) {
        pad.numbered.reset(read.index);
      } else if (read.as == Read::As::button_array) {
        for (std::int64_t value = read.field.minimum; value <= read.field.maximum; ++value) {
          if (const auto index = array_button(read, value)) {
            pad.numbered.reset(*index);
          }
        }
      } else if (read.as == Read::As::button) {
        pad.buttons.reset(read.index);
      } else if (read.as == Read::As::hat) {
        for (const PadButton button :
             {PadButton::dpad_up, PadButton::dpad_down, PadButton::dpad_left, PadButton::dpad_right}) {
          pad.buttons.reset(static_cast<std::size_t>(button));
        }
      }
    }
  }

  static void take(const Read& read, std::int64_t value, RawPad& pad) {
    switch (read.as) {
      case Read::As::axis:
        pad.values[read.index] = static_cast<std::int32_t>(std::clamp<std::int64_t>(
            value, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
        break;
      case Read::As::hat:
        press_hat(pad, direction_of(read.field, value));
        break;
      case Read::As::numbered_button:
        if (value != 0) {
          pad.numbered.set(read.index);
        }
        break;
      case Read::As::button_array:
        if (const auto index = array_button(read, value)) {
          pad.numbered.set(*index);
        }
        break;
      case Read::As::button:
        if (value != 0) {
          pad.buttons.set(read.index);
        }
        break;
    }
  }

  //! Returns the index of the numbered button that an array's value selects.
  static std::optional<std::size_t> array_button(const Read& read, std::int64_t value) {
    const std::int64_t number = static_cast<std::int64_t>(read.index) + value - read.field.minimum;
    const bool selects = value >= read.field.minimum && value <= read.field.maximum && number >= 1 &&
                         number <= static_cast<std::int64_t>(max_numbered_buttons);
    return selects ? std::optional(static_cast<std::size_t>(number - 1)) : std::nullopt;
  }

  //! Returns the nearest of eight directions, clockwise from up, which is the smallest value; -1 if
  //! no direction. Hats have four or eight values, or divide a full turn.
  static int direction_of(const HidField& field, std::int64_t value) {
    const std::int64_t parts = field.maximum - field.minimum + 1;
    if (value < field.minimum || value > field.maximum || parts % 4 != 0) {
      return -1;
    }
    return static_cast<int>((16 * (value - field.minimum) + parts) / (2 * parts) % 8);
  }

  bool has_ids_;
  bool is_puck_ = false;
  std::map<std::uint8_t, std::uint32_t> report_bits_;
  std::vector<Read> reads_;
  std::map<std::size_t, TriggerRest> triggers_;  //!< rest positions of triggers, by index of the raw axis
  RawLayout layout_;
};

}  // namespace

std::unique_ptr<PadDecoder> make_by_descriptor(std::span<const std::uint8_t> descriptor) {
  const HidLayout hid = parse_hid_descriptor(descriptor);
  if (!has_pad(hid)) {
    return nullptr;
  }
  auto decoder = std::make_unique<ByDescriptor>(hid);
  return decoder->reads_anything() ? std::move(decoder) : nullptr;
}

}  // namespace ergodome
