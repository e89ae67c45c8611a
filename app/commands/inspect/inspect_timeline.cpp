#include "app/commands/inspect/inspect_timeline.h"

#include <fmt/format.h>

#include <algorithm>

#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/show/animated_show.h"
#include "content/show/reading/show_files.h"

namespace ergodome {

namespace {

using nlohmann::json;

json file_summary(const Show& show, const NamedFile& file, const std::map<std::string, std::string>& unusable) {
  const auto problem = unusable.find(file.key);
  return {{"file", file.name},
          {"there", is_there(show, file.name)},
          {"folder", is_folder(show, file.name)},
          {"problem", problem == unusable.end() ? "" : problem->second}};
}

json presence_summary(const Presence& presence) { return {{"from_s", presence.from_s}, {"to_s", presence.to_s}}; }

//! Returns a text as printed: all its languages with their tags on one line, each cut to 200 bytes.
std::string shown(const LocalText& text) {
  std::string all;
  for (const auto& [tag, words] : text) {
    std::string line = words.substr(0, 200);
    // Removes the remaining bytes of a UTF-8 character that was cut.
    while (line.size() < words.size() && !line.empty() &&
           (static_cast<unsigned char>(words[line.size()]) & 0xC0U) == 0x80U) {
      line.pop_back();
    }
    std::ranges::replace(line, '\n', ' ');
    all += fmt::format("{}{}{}", all.empty() ? "" : " | ", tag.empty() ? "" : tag + ": ", line);
  }
  return all;
}

std::string shown(const json& text) { return shown(text.get<LocalText>()); }

void print_file(const json& summary, const std::string& more) {
  const char* const missing = summary["there"].get<bool>()    ? ""
                              : summary["folder"].get<bool>() ? "  IS A FOLDER, NOT A FILE"
                                                              : "  MISSING";
  print_out("  {:<40} {}{}\n", summary["file"].get<std::string>(), more, missing);
  if (!summary["problem"].get<std::string>().empty()) {
    print_out("    CANNOT BE USED: {}\n", summary["problem"].get<std::string>());
  }
}

std::string times(const json& summary) {
  return fmt::format("{:>9.3f} s to {:>9.3f} s", summary["from_s"].get<double>(), summary["to_s"].get<double>());
}

}  // namespace

json summary_of_timeline(const Show& show, const std::map<std::string, std::string>& unusable) {
  const Timeline& timeline = show.timeline;
  json summary = {{"languages", languages(show)}, {"duration_s", show.duration_s}};
  for (const NamedFile& file : files_of_pictures(show)) {
    json& added = summary["files"].emplace_back(file_summary(show, file, unusable));
    added["key"] = file.key;
  }
  for (const Animation& animation : timeline.animations) {
    const NumberLimits range = range_of(animation);
    summary["animated"].push_back({{"number", animation.path},
                                   {"keys", animation.keys.size()},
                                   {"from_s", animation.keys.front().time_s},
                                   {"to_s", animation.keys.back().time_s},
                                   {"ends_after_end", animation.keys.back().time_s > show.duration_s},
                                   {"least", range.minimum},
                                   {"greatest", range.maximum}});
  }
  for (const Chapter& chapter : timeline.chapters) {
    summary["chapters"].push_back({{"t_s", chapter.time_s}, {"title", chapter.title}});
  }
  for (const Caption& caption : timeline.captions) {
    json& added = summary["captions"].emplace_back(presence_summary(caption.presence));
    added["text"] = caption.text;
  }
  for (std::size_t i = 0; i < timeline.overlays.size(); ++i) {
    const Overlay& overlay = timeline.overlays[i];
    const NamedFile file = {fmt::format("overlay[{}].image", i), overlay.image};
    json& added = summary["overlays"].emplace_back(file_summary(show, file, unusable));
    added.update(presence_summary(overlay.presence));
    added["fisheye"] = overlay.fisheye;
  }
  for (std::size_t i = 0; i < timeline.audio.size(); ++i) {
    const AudioTrack& track = timeline.audio[i];
    json& added =
        summary["audio"].emplace_back(file_summary(show, {fmt::format("audio[{}].file", i), track.file}, unusable));
    added.update({{"from_s", track.from_s}, {"language", track.language}, {"loop", track.loop}});
  }
  const auto mark_late = [&](const char* list, const char* start) {
    if (summary.contains(list)) {
      for (json& one : summary[list]) {
        one["after_end"] = one[start].get<double>() > show.duration_s;
      }
    }
  };
  mark_late("animated", "from_s");
  mark_late("chapters", "t_s");
  mark_late("captions", "from_s");
  mark_late("overlays", "from_s");
  mark_late("audio", "from_s");
  return summary;
}

void print_timeline(const json& summary) {
  const auto each = [&](const char* name, const auto& print_one) {
    if (summary.contains(name)) {
      print_out("\n{}\n", name);
      for (const json& one : summary[name]) {
        print_one(one);
      }
    }
  };
  if (!summary["languages"].empty()) {
    print_out("{:<16}{}\n", "languages", fmt::join(summary["languages"].get<std::vector<std::string>>(), ", "));
  }
  const auto late = [](const json& one) { return one["after_end"].get<bool>() ? "  AFTER THE END" : ""; };
  each("files", [](const json& one) { print_file(one, one["key"].get<std::string>()); });
  each("animated", [&](const json& one) {
    print_out(
        "  {:<34} {}  {}, {:.6g} to {:.6g}{}\n", one["number"].get<std::string>(), times(one),
        counted(one["keys"].get<int>(), "key"), one["least"].get<double>(), one["greatest"].get<double>(),
        one["ends_after_end"].get<bool>() && !one["after_end"].get<bool>() ? "  CONTINUES AFTER THE END" : late(one));
  });
  each("chapters", [&](const json& one) {
    print_out("  {:>9.3f} s  {}{}\n", one["t_s"].get<double>(), shown(one["title"]), late(one));
  });
  each("captions", [&](const json& one) { print_out("  {}  {}{}\n", times(one), shown(one["text"]), late(one)); });
  each("overlays", [&](const json& one) {
    print_file(one, times(one) + (one["fisheye"].get<bool>() ? "  fisheye" : "") + late(one));
  });
  each("audio", [&](const json& one) {
    const std::string language = one["language"].get<std::string>();
    print_file(one, fmt::format("from {:>9.3f} s{}{}", one["from_s"].get<double>(),
                                language.empty() ? "" : "  " + language, one["loop"].get<bool>() ? "  looped" : "") +
                        late(one));
  });
}

FaultyFiles faulty_files(const json& summary) {
  FaultyFiles files;
  for (const char* const list : {"files", "overlays", "audio"}) {
    for (const json& file : summary.value(list, json::array())) {
      ++files.all;
      files.faulty += file["there"].get<bool>() && file["problem"].get<std::string>().empty() ? 0 : 1;
    }
  }
  return files;
}

}  // namespace ergodome
