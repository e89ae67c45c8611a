#include "content/timeline/timeline_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/camera/camera_path.h"
#include "content/files/printable.h"
#include "content/show/animated_show.h"
#include "content/show/animation_reader.h"

namespace ergodome {

namespace {

constexpr std::size_t most_entries = 10'000;
constexpr std::size_t most_languages = 64;
constexpr double longest_s = 1e9;
constexpr double usual_fade_s = 0.5;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

//! Returns true if a tag has the form of BCP 47: "en", "pt-BR", "zh-Hant".
bool is_language_tag(std::string_view tag) {
  std::size_t part = 0;
  bool first = true;
  for (const char c : tag) {
    const bool digit = c >= '0' && c <= '9';
    if (c == '-' && part > 0) {
      first = false;
      part = 0;
    } else if ((is_letter(c) || (digit && !first)) && part < 8) {
      ++part;
    } else {
      return false;
    }
  }
  const std::size_t language = tag.find('-');
  return part > 0 && std::min(language, tag.size()) >= 2 && tag.size() <= 35;
}

//! Reads a nonempty text for display. TOML guarantees that it is UTF-8.
std::string read_words(TomlTable& table, std::string_view key) {
  std::string words = table.lines(key, "");
  if (words.empty()) {
    throw table.error_at(key, "is empty", "write a text");
  }
  return words;
}

Presence read_presence(TomlTable& table) {
  for (const char* const needed : {"from_s", "to_s"}) {
    if (!table.has(needed)) {
      throw table.error_at(needed, "is missing", "write from_s and to_s: when it appears and when it has disappeared");
    }
  }
  Presence presence;
  presence.from_s = table.number("from_s", 0.0, 0.0, longest_s);
  presence.to_s = table.number("to_s", 0.0, 0.0, longest_s);
  const double there_s = presence.to_s - presence.from_s;
  if (!(there_s > 0.0)) {
    throw table.error_at("to_s", "is not later than from_s", "choose a later time");
  }
  presence.fade_in_s = table.number("fade_in_s", -1.0, 0.0, longest_s);
  presence.fade_out_s = table.number("fade_out_s", -1.0, 0.0, longest_s);
  // Fades without a given duration use the remaining time.
  const auto usual = [&](double other_s) {
    return std::clamp(there_s - other_s, 0.0, std::min(usual_fade_s, 0.5 * there_s));
  };
  if (presence.fade_in_s < 0.0) {
    presence.fade_in_s = usual(std::max(presence.fade_out_s, 0.0));
  }
  if (presence.fade_out_s < 0.0) {
    presence.fade_out_s = usual(presence.fade_in_s);
  }
  // Decimal times that add up exactly may not do so in binary.
  if (!(presence.fade_in_s + presence.fade_out_s <= there_s * (1.0 + 1e-9))) {
    throw table.error_at(
        table.has("fade_out_s") ? "fade_out_s" : "fade_in_s",
        fmt::format("and the other fade together take longer than the {} s from from_s to to_s", there_s),
        "shorten one of the fades");
  }
  return presence;
}

DomePlace read_place(TomlTable& table) {
  DomePlace place;
  place.azimuth_deg = table.number("azimuth_deg", place.azimuth_deg, -360.0, 360.0);
  place.elevation_deg = table.number("elevation_deg", place.elevation_deg, -90.0, 90.0);
  place.roll_deg = table.number("roll_deg", place.roll_deg, -360.0, 360.0);
  return place;
}

Chapter read_chapter(TomlTable& table) {
  if (!table.has("t_s")) {
    throw table.error_at("t_s", "is missing", "write the time at which the chapter begins, for example t_s = 20");
  }
  return {table.number("t_s", 0.0, 0.0, longest_s), read_local_text(table, "title")};
}

Caption read_caption(TomlTable& table) {
  Caption caption;
  caption.presence = read_presence(table);
  caption.place = read_place(table);
  caption.letter_deg = table.number("letter_deg", caption.letter_deg, 0.05, 45.0);
  caption.width_deg = table.number("width_deg", caption.width_deg, 0.5, 360.0);
  const std::vector<double> color = table.numbers("color", 3, 3, 0.0, 1e6);
  std::ranges::copy(color, caption.color.begin());
  caption.text = read_local_text(table, "text");
  return caption;
}

//! Reads a required path.
std::string read_path(TomlTable& table, std::string_view key) {
  std::string path = table.text(key, "");
  if (path.empty()) {
    throw table.error_at(key, "is missing", "write the path of a file, relative to the folder of the show");
  }
  return path;
}

Overlay read_overlay(TomlTable& table) {
  Overlay overlay;
  overlay.image = read_path(table, "image");
  overlay.presence = read_presence(table);
  overlay.fisheye = table.boolean("fisheye", false);
  overlay.place = read_place(table);
  overlay.width_deg = table.number("width_deg", overlay.width_deg, 0.05, 360.0);
  overlay.fov_deg = table.number("fov_deg", overlay.fov_deg, 1.0, 360.0);
  overlay.opacity = table.number("opacity", overlay.opacity, 0.0, 1.0);
  return overlay;
}

AudioTrack read_track(TomlTable& table) {
  AudioTrack track;
  track.file = read_path(table, "file");
  track.from_s = table.number("from_s", 0.0, 0.0, longest_s);
  track.gain_db = table.number("gain_db", 0.0, -120.0, 24.0);
  track.fade_in_s = table.number("fade_in_s", 0.0, 0.0, longest_s);
  track.fade_out_s = table.number("fade_out_s", 0.0, 0.0, longest_s);
  track.language = table.text("language", "");
  if (!track.language.empty() && !is_language_tag(track.language)) {
    throw table.error_at("language",
                         fmt::format("is \"{}\", which is not a language tag", printable(track.language.substr(0, 40))),
                         "write a tag such as \"en\", \"de\" or \"pt-BR\"");
  }
  track.loop = table.boolean("loop", false);
  return track;
}

//! Reads each table of an array with `read`.
template <class Entry>
void read_each(TomlTable& root, const std::string& file, const char* name, std::vector<Entry>& entries,
               Entry (*read)(TomlTable&)) {
  for (const toml::table* each : root.tables(name, most_entries)) {
    TomlTable table(*each, file, fmt::format("{}[{}]", name, entries.size()));
    Entry entry = read(table);
    if constexpr (std::is_same_v<Entry, Chapter>) {
      if (!entries.empty() && !(entry.time_s > entries.back().time_s)) {
        throw table.error_at("t_s", "is not later than that of the previous chapter", "sort the chapters by time");
      }
    }
    table.refuse_unknown_keys();
    entries.push_back(std::move(entry));
  }
}

}  // namespace

LocalText read_local_text(TomlTable& table, std::string_view key) {
  const toml::node* const node = table.node(key);
  if (node == nullptr) {
    throw table.error_at(key, "is missing", "write \"TEXT\", or { en = \"TEXT\", de = \"TEXT\" }");
  }
  if (!node->is_table()) {
    return {{"", read_words(table, key)}};
  }
  const toml::table& languages = *node->as_table();
  if (languages.empty() || languages.size() > most_languages) {
    throw table.error_at(key, languages.empty() ? "has no language" : "has too many languages",
                         fmt::format("give it 1 to {} languages", most_languages));
  }
  TomlTable reader = table.below(languages, key);
  LocalText text;
  for (const auto& [tag, words] : languages) {
    // An empty tag is for languages without a text.
    if (!tag.str().empty() && !is_language_tag(tag.str())) {
      throw reader.error_at(tag.str(), "is not a language tag", "write a tag such as en, de or pt-BR");
    }
    text[std::string(tag.str())] = read_words(reader, tag.str());
  }
  return text;
}

void read_timeline(TomlTable& root, const std::string& file, Show& show) {
  read_animations(root, file, show);
  Timeline& timeline = show.timeline;
  read_each(root, file, "chapter", timeline.chapters, &read_chapter);
  read_each(root, file, "caption", timeline.captions, &read_caption);
  read_each(root, file, "overlay", timeline.overlays, &read_overlay);
  read_each(root, file, "audio", timeline.audio, &read_track);
}

void check_spin_on_path(const std::string& file, const Show& show) {
  const Animation* const spin = find_animation(show, "hole.spin");
  if (spin == nullptr) {
    return;
  }
  std::vector<double> times;
  times.reserve(spin->keys.size() + show.camera.keys.size());
  for (const NumberKey& key : spin->keys) {
    times.push_back(key.time_s);
  }
  for (const CameraKey& key : show.camera.keys) {
    times.push_back(key.time_s);
  }
  std::ranges::sort(times);
  constexpr int between = 8;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double span_s = i + 1 < times.size() ? times[i + 1] - times[i] : 0.0;
    for (int k = 0; k < (span_s > 0.0 ? between : 1); ++k) {
      const double time_s = times[i] + span_s * k / between;
      const double horizon = horizon_radius(value_at(*spin, time_s));
      const double r = camera_pose(show, time_s).r;
      if (!(r > horizon)) {
        const int line = show.lines.at("animate.hole.spin");
        throw Error(
            line == key_set_outside ? show_setting_option : fmt::format("{}:{}", file, line),
            fmt::format("at {:.6g} s this spin has its horizon at {:.6g} M, so that the camera at {:.6g} M is inside",
                        time_s, horizon, r),
            "keep the camera farther out, or choose a larger spin");
      }
    }
  }
}

}  // namespace ergodome
