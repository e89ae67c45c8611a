#include <fmt/format.h>

#include <algorithm>

#include "content/files/printable.h"
#include "content/show/show_schema.h"
#include "content/timeline/local_text.h"

namespace ergodome {

namespace {

constexpr std::size_t max_entries = 10'000;
constexpr double longest_s = 1e9;
constexpr double usual_fade_s = 0.5;
constexpr const char* remedy_for_times = "write from_s and to_s: when it appears and when it has disappeared";

constexpr auto check_times = [](const TomlTable& table, const Presence& presence) {
  if (!(presence.to_s > presence.from_s)) {
    throw table.error_at("to_s", "is not later than from_s", "choose a later time");
  }
};

constexpr auto unset_fades = [](const TomlTable& /*table*/, Presence& presence) {
  presence.fade_in_s = -1.0;
  presence.fade_out_s = -1.0;
};

constexpr auto set_fades = [](const TomlTable& table, Presence& presence) {
  const double there_s = presence.to_s - presence.from_s;
  // A fade without a duration lasts 0.5 s, but at most half of the time from from_s to to_s, and at
  // most the part of that time which the other fade leaves.
  const auto usual = [&](double other_s) {
    return std::clamp(there_s - other_s, 0.0, std::min(usual_fade_s, 0.5 * there_s));
  };
  if (presence.fade_in_s < 0.0) {
    presence.fade_in_s = usual(std::max(presence.fade_out_s, 0.0));
  }
  if (presence.fade_out_s < 0.0) {
    presence.fade_out_s = usual(presence.fade_in_s);
  }
  // The tolerance is for decimal times that add up exactly, but not in binary.
  if (!(presence.fade_in_s + presence.fade_out_s <= there_s * (1.0 + 1e-9))) {
    throw table.error_at(
        table.has("fade_out_s") ? "fade_out_s" : "fade_in_s",
        fmt::format("and the other fade together take longer than the {} s from from_s to to_s", there_s),
        "shorten one of the fades");
  }
};

void require_path(const TomlTable& table, const char* key, const std::string& path) {
  if (path.empty()) {
    throw table.error_at(key, "is missing", "write the path of a file, relative to the folder of the show");
  }
}

constexpr auto presence_keys = keys_of<Presence>(
    key<&Presence::from_s>("from_s", "Start of the fade-in.").range(0.0, longest_s, "s").required(remedy_for_times),
    key<&Presence::to_s>("to_s", "End of the fade-out.")
        .range(0.0, longest_s, "s")
        .required(remedy_for_times)
        .after(check_times)
        .page({.bounds = "above `from_s`, to 1e9"}),
    key<&Presence::fade_in_s>("fade_in_s", "Duration of the fade-in. Both fades fit between `from_s` and `to_s`.")
        .range(0.0, longest_s, "s")
        .before(unset_fades)
        .page({.otherwise = "0.5, or less if the time is short"}),
    key<&Presence::fade_out_s>("fade_out_s", "Duration of the fade-out.")
        .range(0.0, longest_s, "s")
        .after(set_fades)
        .page({.otherwise = "0.5, or less if the time is short"}));

constexpr auto position_keys = keys_of<DomePosition>(
    key<&DomePosition::azimuth_deg>("azimuth_deg", "Angle to the right of the front.").range(-360.0, 360.0, "deg"),
    key<&DomePosition::elevation_deg>("elevation_deg",
                                      "Elevation of the middle above the springline (the dome's horizon).")
        .range(-90.0, 90.0, "deg"),
    key<&DomePosition::roll_deg>("roll_deg", "Clockwise roll.").range(-360.0, 360.0, "deg"));

constexpr const char* remedy_for_values = "write { t_s = 0, value = 1 }";

constexpr auto keys_of_number_key = keys_of<NumberKey>(
    key<&NumberKey::time_s>("t_s", "Time of the value.").range(-1e12, 1e12, "s").required(remedy_for_values),
    key<&NumberKey::value>("value", "Value at that time.")
        .range(-1e12, 1e12)
        .required(remedy_for_values)
        .page({.unit = "as the number", .bounds = "range of the number"}),
    key<&NumberKey::ease>("ease", "Change from this key to the next.")
        .words(ease_names)
        .page({.bounds = "see [easing](#easing)"}));

constexpr auto animation_keys = keys_of<Animation>(
    key<&Animation::path>("number", "Path of the number, for example `\"sky.exposure\"`. Each number has one entry.")
        .page({.otherwise = "required", .bounds = "a key with *yes* in these tables"}),
    table<&Animation::keys>("key", keys_of_number_key, "Values in order of time, at least 1e-6 s apart.")
        .page({.otherwise = "required", .bounds = "1 to 100,000 entries"}));

constexpr auto chapter_keys =
    keys_of<Chapter>(key<&Chapter::time_s>("t_s", "Start of the chapter. Chapters are in order of time.")
                         .range(0.0, longest_s, "s")
                         .required("write the time at which the chapter begins, for example t_s = 20"),
                     key<&Chapter::title>("title", "Name of the chapter: `\"The shadow\"`, or one for each language."));

constexpr auto caption_keys =
    keys_of<Caption>(key<&Caption::text>("text", "The words. `\\n` starts a new line.").page({.bounds = "4096 bytes"}),
                     part<&Caption::presence>(presence_keys), part<&Caption::position>(position_keys),
                     key<&Caption::letter_deg>("letter_deg", "Height of a line.").range(0.05, 45.0, "deg"),
                     key<&Caption::width_deg>("width_deg", "Lines are broken at this width.").range(0.5, 360.0, "deg"),
                     key<&Caption::color>("color", "Linear light, relative to white.").range(0.0, 1e6));

constexpr auto overlay_keys = keys_of<Overlay>(
    key<&Overlay::image>("image", "Image file ([formats](captions.md#images)).")
        .after([](const TomlTable& table, const Overlay& overlay) { require_path(table, "image", overlay.image); })
        .page({.type = "path", .otherwise = "required"}),
    part<&Overlay::presence>(presence_keys), part<&Overlay::position>(position_keys),
    key<&Overlay::width_deg>("width_deg", "Width of a flat image.")
        .range(0.05, 360.0, "deg")
        .page({.bounds = "0.05 to 150"}),
    key<&Overlay::opacity>("opacity", "Opacity.").range(0.0, 1.0),
    key<&Overlay::fisheye>("fisheye",
                           "`true`: the image is a square equidistant domemaster that covers the whole dome."),
    key<&Overlay::fov_deg>("fov_deg", "Field of view of a fisheye image.").range(1.0, 360.0, "deg"));

constexpr auto check_language = [](const TomlTable& table, const AudioTrack& track) {
  if (!track.language.empty() && !is_language_tag(track.language)) {
    throw table.error_at("language",
                         fmt::format("is \"{}\", which is not a language tag", printable(track.language.substr(0, 40))),
                         "write a tag such as \"en\", \"de\" or \"pt-BR\"");
  }
};

constexpr auto track_keys = keys_of<AudioTrack>(
    key<&AudioTrack::file>("file", "Sound file with 1 to 8 channels, 8 to 192 kHz.")
        .after([](const TomlTable& table, const AudioTrack& track) { require_path(table, "file", track.file); })
        .page({.type = "path", .otherwise = "required", .bounds = "WAV, FLAC, Ogg Vorbis, Opus, MP3, ..."}),
    key<&AudioTrack::from_s>("from_s", "Start of the track.").range(0.0, longest_s, "s"),
    key<&AudioTrack::gain_db>("gain_db", "Gain.").range(-120.0, 24.0, "dB"),
    key<&AudioTrack::fade_in_s>("fade_in_s", "Duration of the track's fade-in.").range(0.0, longest_s, "s"),
    key<&AudioTrack::fade_out_s>("fade_out_s", "Duration of the track's fade-out.").range(0.0, longest_s, "s"),
    key<&AudioTrack::loop>("loop", "Repeats the track."),
    key<&AudioTrack::language>("language", "The track is heard in this language only.")
        .after(check_language)
        .page({.type = "language tag", .otherwise = "absent: all languages", .bounds = "for example `\"de\"`"}));

constexpr auto check_order_of_chapters = [](TomlTable& root, const Timeline& timeline) {
  const auto tables = root.tables("chapter", max_entries);
  for (std::size_t i = 1; i < tables.size(); ++i) {
    if (!(timeline.chapters[i].time_s > timeline.chapters[i - 1].time_s)) {
      throw root.below(*tables[i], fmt::format("chapter[{}]", i))
          .error_at("t_s", "is not later than that of the previous chapter", "sort the chapters by time");
    }
  }
};

constexpr auto keys_of_timeline = keys_of<Timeline>(
    // Only marks the key as known. read_animations() reads the animations later, when the limits of
    // their numbers are known.
    table<&Timeline::animations>("animate", animation_keys).by([](TomlTable& root, Timeline& /*timeline*/) {
      root.node("animate");
    }),
    table<&Timeline::chapters>("chapter", chapter_keys, "", max_entries).after(check_order_of_chapters),
    table<&Timeline::captions>("caption", caption_keys, "", max_entries),
    table<&Timeline::overlays>("overlay", overlay_keys, "", max_entries),
    table<&Timeline::audio>("audio", track_keys, "", max_entries));

}  // namespace

constinit const KeyTable<NumberKey> number_key_keys = keys_of_number_key;
constinit const KeyTable<Timeline> timeline_keys = keys_of_timeline;

}  // namespace ergodome
