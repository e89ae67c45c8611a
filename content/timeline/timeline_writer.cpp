#include "content/timeline/timeline_writer.h"

#include <utility>

namespace ergodome {

namespace {

void add_presence(const Presence& presence, toml::table& table) {
  table.insert("from_s", presence.from_s);
  table.insert("to_s", presence.to_s);
  table.insert("fade_in_s", presence.fade_in_s);
  table.insert("fade_out_s", presence.fade_out_s);
}

void add_place(const DomePlace& place, toml::table& table) {
  table.insert("azimuth_deg", place.azimuth_deg);
  table.insert("elevation_deg", place.elevation_deg);
  table.insert("roll_deg", place.roll_deg);
}

toml::table table_of(const Animation& animation) {
  toml::array keys;
  for (const NumberKey& key : animation.keys) {
    keys.push_back(toml::table{
        {"t_s", key.time_s}, {"value", key.value}, {"ease", ease_names[static_cast<std::size_t>(key.ease)]}});
  }
  return toml::table{{"number", animation.path}, {"key", std::move(keys)}};
}

toml::table table_of(const Chapter& chapter) {
  toml::table table{{"t_s", chapter.time_s}};
  add_local_text(chapter.title, "title", table);
  return table;
}

toml::table table_of(const Caption& caption) {
  toml::table table{{"letter_deg", caption.letter_deg},
                    {"width_deg", caption.width_deg},
                    {"color", toml::array{caption.color[0], caption.color[1], caption.color[2]}}};
  add_presence(caption.presence, table);
  add_place(caption.place, table);
  add_local_text(caption.text, "text", table);
  return table;
}

toml::table table_of(const Overlay& overlay) {
  toml::table table{{"image", overlay.image},
                    {"fisheye", overlay.fisheye},
                    {"width_deg", overlay.width_deg},
                    {"fov_deg", overlay.fov_deg},
                    {"opacity", overlay.opacity}};
  add_presence(overlay.presence, table);
  add_place(overlay.place, table);
  return table;
}

toml::table table_of(const AudioTrack& track) {
  return toml::table{{"file", track.file},
                     {"from_s", track.from_s},
                     {"gain_db", track.gain_db},
                     {"fade_in_s", track.fade_in_s},
                     {"fade_out_s", track.fade_out_s},
                     {"language", track.language},
                     {"loop", track.loop}};
}

template <class Entry>
void add_each(const std::vector<Entry>& entries, const char* name, toml::table& root) {
  toml::array list;
  for (const Entry& each : entries) {
    list.push_back(table_of(each));
  }
  if (!list.empty()) {
    root.insert(name, std::move(list));
  }
}

}  // namespace

void add_local_text(const LocalText& text, const char* key, toml::table& table) {
  if (text.size() == 1 && text.begin()->first.empty()) {
    table.insert(key, text.begin()->second);
    return;
  }
  toml::table languages;
  for (const auto& [tag, words] : text) {
    languages.insert(tag, words);
  }
  table.insert(key, std::move(languages));
}

void add_timeline(const Timeline& timeline, toml::table& root) {
  add_each(timeline.animations, "animate", root);
  add_each(timeline.chapters, "chapter", root);
  add_each(timeline.captions, "caption", root);
  add_each(timeline.overlays, "overlay", root);
  add_each(timeline.audio, "audio", root);
}

}  // namespace ergodome
