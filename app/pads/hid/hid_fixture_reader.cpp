#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/pads/hid/hid_fixture.h"
#include "app/pads/hid/hid_text.h"
#include "content/files/toml_table.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t max_mib = 4;
constexpr std::size_t max_devices = 16;
constexpr std::size_t max_listed_events = 20'000;
constexpr std::size_t max_events = 200'000;
constexpr std::size_t longest_fixture_report = 65'536;
constexpr double longest_ms = 86'400'000.0;

int digit_of(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  const int lower = std::tolower(static_cast<unsigned char>(c));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

class FixtureReader {
 public:
  FixtureReader(const toml::table& root, const std::string& file) : root_(root, file, ""), file_(file) {}

  HidFixture read() {
    HidFixture fixture;
    fixture.source = root_.lines("source", "");
    const std::vector<const toml::table*> devices = root_.tables("device", max_devices);
    for (std::size_t i = 0; i < devices.size(); ++i) {
      fixture.devices.push_back(read_device(*devices[i], fmt::format("device[{}]", i + 1)));
    }
    root_.refuse_unknown_keys();
    return fixture;
  }

 private:
  FixtureDevice read_device(const toml::table& found, const std::string& path) {
    TomlTable table(found, file_, path);
    FixtureDevice device;
    device.info.path = table.text("path", "/dev/hidraw0");
    device.info.vendor = read_id(table, "vid");
    device.info.product = read_id(table, "pid");
    device.info.name = without_controls(table.text("name", ""));
    device.info.serial = without_controls(table.text("serial", ""));
    device.info.bus = static_cast<HidBus>(table.choice("bus", 0, {"usb", "bluetooth", "other"}));
    device.info.usages = read_usages(table);
    device.descriptor = read_hex(table, "descriptor");
    device.present = table.boolean("present", true);
    device.allowed = table.boolean("permission", true);
    device.repeat_s = table.number("repeat_ms", 0.0, 0.0, longest_ms) / 1000.0;
    for (const toml::table* const feature : table.tables("feature", 64)) {
      TomlTable answer(*feature, file_, path + ".feature");
      device.features.push_back(read_hex(answer, "hex"));
      answer.refuse_unknown_keys();
    }
    for (const toml::table* const event : table.tables("event", max_listed_events)) {
      TomlTable one(*event, file_, path + ".event");
      read_event(one, device);
    }
    std::stable_sort(device.timeline.begin(), device.timeline.end(),
                     [](const HidEvent& a, const HidEvent& b) { return a.t_s < b.t_s; });
    if (device.repeat_s > 0.0 && !device.timeline.empty() && device.timeline.back().t_s >= device.repeat_s) {
      throw table.error_at("repeat_ms", "is not later than the last event", "choose a larger value");
    }
    table.refuse_unknown_keys();
    return device;
  }

  void read_event(TomlTable& table, FixtureDevice& device) {
    HidEvent event;
    event.t_s = table.number("t_ms", 0.0, 0.0, longest_ms) / 1000.0;
    event.expect = table.text("expect", "");
    const int count = table.integer("count", 1, 1, static_cast<int>(max_events));
    const double every_s = table.number("every_ms", 1.0, 0.0, longest_ms) / 1000.0;
    set_kind(table, event);
    table.refuse_unknown_keys();
    // Repeating a large report uses much memory, so the expanded size is limited.
    expanded_bytes_ += (sizeof(HidEvent) + event.bytes.size() + event.expect.size()) * static_cast<std::size_t>(count);
    if (expanded_bytes_ > (std::size_t{64} << 20U) || device.timeline.size() + count > max_events) {
      throw table.error_at("count", "produces too many events",
                           fmt::format("a fixture may contain at most {} events and 64 MiB", max_events));
    }
    for (int i = 0; i < count; ++i) {
      device.timeline.push_back(event);
      event.t_s += every_s;
    }
  }

  static void set_kind(TomlTable& table, HidEvent& event) {
    using enum HidEvent::Kind;
    event.bytes = read_hex(table, "hex");
    const bool connects = table.has("connect");
    event.path = table.text("connect", "");
    const bool disconnects = table.boolean("disconnect", false);
    const bool fails = table.boolean("error", false);
    const bool permits = table.has("permission");
    const bool allows = table.boolean("permission", true);
    if (static_cast<int>(!event.bytes.empty()) + static_cast<int>(connects) + static_cast<int>(disconnects) +
            static_cast<int>(fails) + static_cast<int>(permits) !=
        1) {
      throw table.error_at("hex", "is missing, or is not the only event in this table",
                           "write exactly one of hex, connect, disconnect = true, error = true or permission");
    }
    if (connects) {
      event.kind = connect;
    } else if (disconnects) {
      event.kind = disconnect;
    } else if (fails) {
      event.kind = error;
    } else if (permits) {
      event.kind = allows ? allow : deny;
    }
  }

  static std::uint16_t read_id(TomlTable& table, std::string_view key) {
    const std::string text = table.text(key, "");
    unsigned value = 0;
    if (text.size() != 4 || !std::all_of(text.begin(), text.end(), [](char c) { return digit_of(c) >= 0; })) {
      throw table.error_at(key, "is not four hexadecimal digits", "write for example \"054c\"");
    }
    for (const char c : text) {
      value = value * 16 + static_cast<unsigned>(digit_of(c));
    }
    return static_cast<std::uint16_t>(value);
  }

  //! Reads bytes in hex, with blanks anywhere between digits.
  static std::vector<std::uint8_t> read_hex(TomlTable& table, std::string_view key) {
    const toml::node* const node = table.node(key);
    std::vector<std::uint8_t> bytes;
    if (node == nullptr) {
      return bytes;
    }
    const auto text = node->value_exact<std::string>();
    int half = -1;
    for (const char c : text.value_or("?")) {
      if (c == ' ' || c == '\n') {
        continue;
      }
      const int digit = digit_of(c);
      if (digit < 0 || bytes.size() >= longest_fixture_report) {
        throw table.error_at(key, "is not a list of bytes in hexadecimal",
                             "write for example \"01 80 7f\", at most 65,536 bytes");
      }
      if (half < 0) {
        half = digit;
      } else {
        bytes.push_back(static_cast<std::uint8_t>(half * 16 + digit));
        half = -1;
      }
    }
    if (half >= 0) {
      throw table.error_at(key, "ends in the middle of a byte", "write two digits for each byte");
    }
    return bytes;
  }

  //! Reads "1:5", or several usages separated by blanks.
  static std::vector<HidUsage> read_usages(TomlTable& table) {
    std::vector<HidUsage> usages;
    const std::string text = table.text("usage", "");
    std::size_t at = 0;
    while (at < text.size() && usages.size() < 16) {
      unsigned page = 0;
      unsigned usage = 0;
      int used = 0;
      if (std::sscanf(text.c_str() + at, " %4u:%4u%n", &page, &usage, &used) != 2) {
        throw table.error_at("usage", "is not a HID usage", "write page and number, for example \"1:5\"");
      }
      usages.push_back({static_cast<std::uint16_t>(page), static_cast<std::uint16_t>(usage)});
      at += static_cast<std::size_t>(used);
    }
    return usages;
  }

  TomlTable root_;
  const std::string& file_;
  std::size_t expanded_bytes_ = 0;
};

}  // namespace

HidFixture parse_hid_fixture(std::string_view text, const std::string& file) {
  const toml::table root = parse_toml(text, file, max_mib, "a fixture");
  return FixtureReader(root, file).read();
}

HidFixture load_hid_fixture(const std::filesystem::path& path) {
  return parse_hid_fixture(read_whole_file(path, max_mib << 20U, "a fixture is a TOML file of reports"), path.string());
}

}  // namespace ergodome
