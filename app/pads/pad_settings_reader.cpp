#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/pads/pad_settings.h"
#include "app/pads/state/pad_names.h"
#include "app/pads/state/pad_state.h"
#include "content/files/toml_table.h"

namespace ergodome {

namespace {

constexpr std::size_t max_profiles = 64;

class ProfileReader {
 public:
  ProfileReader(const toml::table& table, const std::string& file, const std::string& path, PadProfile start)
      : table_(table, file, path), file_(file), profile_(std::move(start)) {}

  //! Reads which controllers the profile applies to.
  void read_identity() {
    profile_.device = table_.text("device", "");
    profile_.name = table_.text("name", "");
    profile_.serial = table_.text("serial", "");
    if (profile_.device.empty() && profile_.name.empty() && profile_.serial.empty()) {
      throw table_.error_at("device", "is missing, and so are name and serial",
                            "write for example device = \"054c:0ce6\", as listed by `ergodome pad`");
    }
    if (!profile_.device.empty() && !is_device_id(profile_.device)) {
      throw table_.error_at("device", "is not a vendor and product id",
                            "write four lower-case hex digits, a colon and four more");
    }
  }

  //! Throws Error if an earlier profile applies to the same controllers, so that this one would
  //! never be used.
  void refuse_repetition(const std::vector<PadProfile>& earlier) const {
    const auto same = std::find_if(earlier.begin(), earlier.end(), [&](const PadProfile& profile) {
      return profile.device == profile_.device && profile.name == profile_.name && profile.serial == profile_.serial;
    });
    if (same == earlier.end()) {
      return;
    }
    const char* const key = !profile_.device.empty() ? "device" : !profile_.serial.empty() ? "serial" : "name";
    throw table_.error_at(key, fmt::format("is already used by pad[{}]", same - earlier.begin() + 1),
                          "merge both [[pad]] tables, or add the serial of each pad, as listed by `ergodome pad`");
  }

  PadProfile read() {
    profile_.ignore = table_.boolean("ignore", profile_.ignore);
    profile_.mode_switch = table_.boolean("mode_switch", profile_.mode_switch);
    read_curve("left_stick", profile_.left_stick);
    read_curve("right_stick", profile_.right_stick);
    read_curve("triggers", profile_.triggers);
    read_curve("puck", profile_.puck);
    read_inverted();
    read_axes();
    read_buttons();
    read_calibration();
    table_.refuse_unknown_keys();
    return std::move(profile_);
  }

 private:
  static bool is_device_id(const std::string& text) {
    const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    return text.size() == 9 && text[4] == ':' && std::all_of(text.begin(), text.begin() + 4, is_hex) &&
           std::all_of(text.begin() + 5, text.end(), is_hex);
  }

  void read_curve(std::string_view key, PadCurve& curve) {
    const toml::table* const found = table_.table(key);
    if (found == nullptr) {
      return;
    }
    TomlTable table(*found, file_, table_.path_of(key));
    curve.dead_zone = table.number("dead_zone", curve.dead_zone, 0.0, 0.9);
    curve.full_at = table.number("full_at", curve.full_at, 0.1, 1.0);
    curve.exponent = table.number("exponent", curve.exponent, 0.2, 5.0);
    curve.expo = table.number("expo", curve.expo, 0.0, 1.0);
    if (curve.full_at < curve.dead_zone + 0.05) {
      throw table.error_at("full_at", "is not at least 0.05 larger than dead_zone",
                           "increase full_at or reduce dead_zone");
    }
    table.refuse_unknown_keys();
  }

  //! Reads a list of texts.
  std::vector<std::string> words(std::string_view key, std::size_t limit) {
    std::vector<std::string> found;
    const toml::node* const node = table_.node(key);
    if (node == nullptr) {
      return found;
    }
    const toml::array* const list = node->as_array();
    if (list == nullptr || list->size() > limit) {
      throw table_.error_at(key, "is not a list of names", fmt::format("write at most {} names in brackets", limit));
    }
    for (const toml::node& item : *list) {
      const auto word = item.value_exact<std::string>();
      if (!word) {
        throw table_.error_at(key, "contains a value that is not text", "write names in quotes");
      }
      found.push_back(*word);
    }
    return found;
  }

  Error unknown(std::string_view key, const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(word, known);
    return table_.error_at(key, fmt::format("contains the unknown name \"{}\"", word.substr(0, 60)),
                           nearest.empty() ? fmt::format("choose from {}", fmt::join(known, ", "))
                                           : fmt::format("did you mean \"{}\"?", nearest));
  }

  void read_inverted() {
    if (!table_.has("invert")) {
      table_.node("invert");
      return;
    }
    profile_.inverted.reset();
    for (const std::string& word : words("invert", pad_axis_count)) {
      const auto axis = pad_axis_named(word);
      if (!axis) {
        throw unknown("invert", word, pad_axis_names());
      }
      profile_.inverted.set(static_cast<std::size_t>(*axis));
    }
  }

  void read_buttons() {
    if (!table_.has("buttons")) {
      table_.node("buttons");
      return;
    }
    profile_.buttons.clear();
    for (const std::string& word : words("buttons", max_numbered_buttons)) {
      const auto button = pad_button_named(word);
      if (!button && word != "none") {
        std::vector<std::string> known = pad_button_names();
        known.emplace_back("none");
        throw unknown("buttons", word, known);
      }
      profile_.buttons.push_back(button);
    }
  }

  //! Returns the subtable whose keys are names of raw axes; nullptr if it is missing.
  const toml::table* table_of_axes(std::string_view key) {
    const toml::table* const found = table_.table(key);
    if (found != nullptr && found->size() > max_raw_axes) {
      throw table_.error_at(key, "has too many axes", fmt::format("a controller has at most {}", max_raw_axes));
    }
    if (found != nullptr) {
      refuse_unknown_axes(*found, key);
    }
    return found;
  }

  void refuse_unknown_axes(const toml::table& axes, std::string_view key) const {
    for (const auto& [name, value] : axes) {
      if (!is_raw_axis_name(name.str())) {
        const std::vector<std::string> known = raw_axis_names();
        const std::string nearest = nearest_word(name.str(), known);
        throw TomlTable(axes, file_, table_.path_of(key))
            .error_at(name.str(), "is not an axis of a controller",
                      nearest.empty() ? fmt::format("choose from {}", fmt::join(known, ", "))
                                      : fmt::format("did you mean \"{}\"?", nearest));
      }
    }
  }

  void read_axes() {
    const toml::table* const found = table_of_axes("axes");
    if (found == nullptr) {
      return;
    }
    profile_.axes.clear();
    TomlTable table(*found, file_, table_.path_of("axes"));
    for (const auto& [key, value] : *found) {
      std::string target = table.text(key.str(), "");
      const bool inverted = target.starts_with('-');
      const std::string word = inverted ? target.substr(1) : target;
      const auto axis = pad_axis_named(word);
      if (!axis && word != "none") {
        std::vector<std::string> known = pad_axis_names();
        known.emplace_back("none");
        const std::string nearest = nearest_word(word, known);
        throw table.error_at(key.str(), fmt::format("has the unknown value \"{}\"", target.substr(0, 60)),
                             nearest.empty() ? fmt::format("choose from {}", fmt::join(known, ", "))
                                             : fmt::format("did you mean \"{}\"?", nearest));
      }
      profile_.axes[std::string(key.str())] = {axis, inverted};
    }
  }

  void read_calibration() {
    const toml::table* const found = table_of_axes("calibration");
    if (found == nullptr) {
      return;
    }
    profile_.calibration.clear();
    TomlTable table(*found, file_, table_.path_of("calibration"));
    for (const auto& [key, value] : *found) {
      constexpr double limit = 2147483647.0;
      const std::vector<double> range = table.numbers(key.str(), 3, 3, -limit, limit);
      const AxisCalibration calibration{static_cast<std::int32_t>(range[0]), static_cast<std::int32_t>(range[1]),
                                        static_cast<std::int32_t>(range[2])};
      if (calibration.minimum > calibration.centre || calibration.centre > calibration.maximum ||
          calibration.minimum == calibration.maximum) {
        throw table.error_at(key.str(), "is not in rising order", "write [minimum, center, maximum]");
      }
      profile_.calibration[std::string(key.str())] = calibration;
    }
  }

  TomlTable table_;
  const std::string& file_;
  PadProfile profile_;
};

}  // namespace

PadSettings parse_pad_settings(std::string_view text, const std::string& file) {
  const toml::table root = parse_toml(text, file, 1, "a pad settings file");
  TomlTable table(root, file, "");
  PadSettings settings;
  settings.stuck_after_s = table.number("stuck_after_s", settings.stuck_after_s, 0.0, 86'400.0);
  if (const toml::table* const otherwise = table.table("default")) {
    settings.otherwise = ProfileReader(*otherwise, file, "default", settings.otherwise).read();
  }
  const std::vector<const toml::table*> pads = table.tables("pad", max_profiles);
  settings.pads.reserve(pads.size());
  for (std::size_t i = 0; i < pads.size(); ++i) {
    ProfileReader reader(*pads[i], file, fmt::format("pad[{}]", i + 1), settings.otherwise);
    reader.read_identity();
    reader.refuse_repetition(settings.pads);
    settings.pads.push_back(reader.read());
  }
  table.refuse_unknown_keys();
  return settings;
}

}  // namespace ergodome
