#include "app/remote/web/json_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "app/remote/common/command_rules.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

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
