#include "app/remote/web/web_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "app/remote/common/command_rules.h"
#include "kernels/core/error.h"

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

json nodes_of(const PlayerStatus& status) {
  json nodes = json::array();
  for (const NodeStatus& node : status.nodes) {
    nodes.push_back({{"name", node.name},
                     {"state", node.state},
                     {"frame_ms", node.frame_ms},
                     {"late_frames", node.late_frames},
                     {"lost", node.lost},
                     {"rejoined", node.rejoined},
                     {"problem", node.problem}});
  }
  return nodes;
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

using nlohmann::json;

const std::string form = R"(send {"kind": "seek", "value": 12.5} or {"kind": "language", "text": "de"})";

//! Parses an object without nested values. Deeper levels are discarded while parsing.
json flat_object(std::string_view text) {
  if (text.size() > largest_json_command) {
    throw Error("command", fmt::format("longer than {} bytes", largest_json_command), form);
  }
  bool nested = false;
  const auto keep_flat = [&](int depth, json::parse_event_t event, const json&) {
    const bool opens = event == json::parse_event_t::object_start || event == json::parse_event_t::array_start;
    nested = nested || (opens && depth > 0);
    return depth <= 1;
  };
  json object = json::parse(text.begin(), text.end(), keep_flat, false);
  if (object.is_discarded() || !object.is_object() || nested) {
    throw Error("command", nested ? "contains a nested object or array" : "is not a JSON object", form);
  }
  return object;
}

std::string kind_of(const json& object) {
  const auto kind = object.find("kind");
  if (kind == object.end() || !kind->is_string()) {
    throw Error("command", "has no \"kind\"", form);
  }
  return *kind;
}

CommandArgument argument_of(const json& object) {
  const auto value = object.find("value");
  const auto text = object.find("text");
  if (value != object.end() && text != object.end()) {
    throw Error("command", "has both \"value\" and \"text\"", "send one of them");
  }
  if (text != object.end()) {
    if (!text->is_string()) {
      throw Error("command", "\"text\" is not a string", form);
    }
    return text->get<std::string>();
  }
  if (value == object.end() || value->is_null()) {
    return {};
  }
  if (value->is_boolean()) {
    return value->get<bool>();
  }
  if (!value->is_number()) {
    throw Error("command", "\"value\" is neither a number nor true or false", form);
  }
  return value->get<double>();
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
                       {"display", status.display},
                       {"frame_ms", status.frame_ms},
                       {"worst_frame_ms", status.worst_frame_ms},
                       {"frames", status.frames},
                       {"dropped_frames", status.dropped_frames},
                       {"pads", pads_of(status)},
                       {"nodes", nodes_of(status)},
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

TransportCommand parse_json_command(std::string_view text, const PlayerStatus& status) {
  const json object = flat_object(text);
  for (const auto& [key, unused] : object.items()) {
    if (key != "kind" && key != "value" && key != "text") {
      throw Error("command", "has a key that is neither \"kind\", \"value\" nor \"text\"", form);
    }
  }
  const std::string kind = kind_of(object);
  const CommandRule* const rule = rule_of(kind);
  if (rule == nullptr) {
    const std::string nearest = nearest_command(kind);
    throw Error("command", "\"kind\" is not a known command",
                nearest.empty() ? "see reference/http.md in the documentation" : "did you mean \"" + nearest + "\"?");
  }
  return checked_command(*rule, argument_of(object), status);
}

}  // namespace ergodome
