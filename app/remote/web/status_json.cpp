#include "app/remote/web/status_json.h"

#include <nlohmann/json.hpp>

#include "app/remote/common/command_rules.h"

namespace ergodome {

namespace {

using nlohmann::json;

std::string text_of(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

json chapters_of(const PlayerStatus& status) {
  json chapters = json::array();
  for (const ChapterStatus& chapter : status.chapters) {
    chapters.push_back({{"time_s", chapter.time_s}, {"title", chapter.title}});
  }
  return chapters;
}

json pads_of(const PlayerStatus& status) {
  json pads = json::array();
  for (const PadStatus& pad : status.pads) {
    pads.push_back({{"name", pad.name}, {"connection", pad.connection}, {"active", pad.active}});
  }
  return pads;
}

//! Returns the commands that would be refused now, with the reason of each.
json refused_of(const PlayerStatus& status) {
  json refused = json::object();
  for (const CommandRule& rule : command_rules()) {
    if (const std::string reason = refusal_now(rule, status); !reason.empty()) {
      refused[std::string(rule.name)] = reason;
    }
  }
  return refused;
}

}  // namespace

std::string status_json(const PlayerStatus& status) {
  const json object = {{"title", status.title},
                       {"time_s", status.time_s},
                       {"duration_s", status.duration_s},
                       {"playing", status.playing},
                       {"free_flight", status.free_flight},
                       {"speed", status.speed},
                       {"loop", status.loop},
                       {"blackout", status.blackout},
                       {"exposure_stops", status.exposure_stops},
                       {"baseline", status.baseline},
                       {"baseline_used", status.baseline_used},
                       {"stereo", status.stereo},
                       {"volume", status.volume},
                       {"language", status.language},
                       {"languages", status.languages},
                       {"captions", status.captions},
                       {"chapter", status.chapter},
                       {"chapters", chapters_of(status)},
                       {"clock", status.clock},
                       {"follows", status.follows},
                       {"clock_state", status.clock_state},
                       {"clock_silence_s", status.clock_silence_s ? json(*status.clock_silence_s) : json()},
                       {"refused", refused_of(status)},
                       {"sound", status.sound},
                       {"observer", status.observer},
                       {"lens", status.lens},
                       {"backend", status.backend},
                       {"frame_ms", status.frame_ms},
                       {"worst_frame_ms", status.worst_frame_ms},
                       {"frames", status.frames},
                       {"dropped_frames", status.dropped_frames},
                       {"pads", pads_of(status)},
                       {"problem", status.problem}};
  return text_of(object);
}

std::string log_json(const std::vector<LogLine>& lines) {
  json array = json::array();
  for (const LogLine& line : lines) {
    const auto since_1970 = std::chrono::duration_cast<std::chrono::milliseconds>(line.time.time_since_epoch());
    const spdlog::string_view_t level = spdlog::level::to_string_view(line.level);
    array.push_back({{"number", line.number},
                     {"time_ms", since_1970.count()},
                     {"level", std::string(level.data(), level.size())},
                     {"text", line.text}});
  }
  return text_of(array);
}

std::string answer_json(const std::string& error) {
  return text_of(error.empty() ? json{{"ok", true}} : json{{"error", error}});
}

}  // namespace ergodome
