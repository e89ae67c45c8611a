#include "tests/support/openxr_runtime/runtime_script.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace ergodome::openxr_test {

namespace {

const std::set<std::string> script_modes = {
    "changes_context", "exit", "focus_lost", "gl_error", "huge",         "instance_lost",      "invalid_poses",
    "linear_only",     "mono", "no_layers",  "no_stage", "no_system",    "no_system_at_first", "not_focused_first",
    "one_format",      "quad", "recenter",   "restart",  "session_lost", "slow_wait",          "taken_off",
    "time_jumps",      "tiny"};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    if (!part.empty()) {
      parts.push_back(part);
    }
  }
  return parts;
}

//! Parses a positive number; records an error if it is not one.
double number_of(const std::string& key, const std::string& value, Script& script) {
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (end == value.c_str() || *end != '\0' || !(number > 0)) {
    script.errors.push_back(key + ": not a positive number: " + value);
    return 1;
  }
  return number;
}

void read_size(const std::string& value, Script& script) {
  char by = 0;
  std::istringstream stream(value);
  if (!(stream >> script.width >> by >> script.height) || by != 'x' || !stream.eof()) {
    script.errors.push_back("size: not WxH: " + value);
  }
}

void read_inputs(const std::string& file_name, Script& script) {
  std::ifstream file(file_name);
  if (!file) {
    script.errors.push_back("input: cannot read " + file_name);
  }
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    Script::Input input;
    std::istringstream stream(line);
    if (stream >> input.frame >> input.path >> input.value) {
      script.inputs.push_back(input);
    } else {
      script.errors.push_back("input: not 'FRAME PATH VALUE': " + line);
    }
  }
}

void read_modes(const std::string& value, Script& script) {
  for (const std::string& mode : split(value, ',')) {
    if (!script_modes.contains(mode)) {
      script.errors.push_back("modes: unknown mode " + mode);
    }
    script.modes.insert(mode);
  }
}

void read_key(const std::string& key, const std::string& value, Script& script) {
  if (key == "log") {
    script.log_file = value;
  } else if (key == "frames") {
    script.frames = static_cast<std::uint64_t>(number_of(key, value, script));
  } else if (key == "rate") {
    script.rate_hz = number_of(key, value, script);
  } else if (key == "pace" && (value == "real" || value == "fast")) {
    script.waits_in_real_time = value == "real";
  } else if (key == "size") {
    read_size(value, script);
  } else if (key == "pictures") {
    script.pictures_folder = value;
  } else if (key == "every") {
    script.picture_every = static_cast<std::uint64_t>(number_of(key, value, script));
  } else if (key == "ipd") {
    script.interpupillary_distance_m = number_of(key, value, script);
  } else if (key == "profile") {
    script.profile = value;
  } else if (key == "input") {
    read_inputs(value, script);
  } else if (key == "modes") {
    read_modes(value, script);
  } else {
    script.errors.push_back("unknown key or value: " + key + "=" + value);
  }
}

}  // namespace

std::map<std::string, float> Script::inputs_at(std::uint64_t frame) const {
  std::map<std::string, float> values;
  for (const Input& input : inputs) {
    if (input.frame <= frame) {
      values[input.path] = input.value;
    }
  }
  return values;
}

Script parse_script(const std::string& text) {
  Script script;
  for (const std::string& part : split(text, ';')) {
    const std::size_t at = part.find('=');
    read_key(part.substr(0, at), at == std::string::npos ? "" : part.substr(at + 1), script);
  }
  if (script.has("tiny")) {
    script.width = script.height = 1;
  } else if (script.has("huge")) {
    script.width = script.height = 4000;
  }
  return script;
}

}  // namespace ergodome::openxr_test
