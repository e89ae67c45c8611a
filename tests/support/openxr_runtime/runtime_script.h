#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ergodome::openxr_test {

//! How the test runtime behaves: the environment variable ERGODOME_OPENXR_TEST, parsed.
struct Script {
  //! One line of the input script: a component of a controller has a value from a frame on.
  struct Input {
    std::uint64_t frame = 0;
    std::string path;
    float value = 0;
  };

  std::string log_file;
  std::string pictures_folder;
  std::uint64_t picture_every = 1;
  //! The runtime ends the session after this many frames; 0: never.
  std::uint64_t frames = 0;
  double rate_hz = 90;
  bool waits_in_real_time = false;
  std::uint32_t width = 320;
  std::uint32_t height = 352;
  double interpupillary_distance_m = 0.064;
  std::string profile = "/interaction_profiles/oculus/touch_controller";
  std::vector<Input> inputs;
  std::set<std::string> modes;
  //! Messages about parts that could not be parsed.
  std::vector<std::string> errors;

  [[nodiscard]] bool has(const char* mode) const { return modes.contains(mode); }
  [[nodiscard]] std::int64_t period_ns() const { return static_cast<std::int64_t>(1e9 / rate_hz); }
  //! Returns the values of all components at a frame. Components that were never set are missing.
  [[nodiscard]] std::map<std::string, float> inputs_at(std::uint64_t frame) const;
};

//! Parses a list `key=value;key=value`; reads the file of the key `input`.
[[nodiscard]] Script parse_script(const std::string& text);

}  // namespace ergodome::openxr_test
