#pragma once

#include <openxr/openxr.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace ergodome::openxr_test {

using Json = nlohmann::ordered_json;

//! The result of a call, thrown by the function that implements it.
struct Failure {
  XrResult result = XR_ERROR_RUNTIME_FAILURE;
};

//! The log of an instance: one JSON object a line, written at once.
class Log {
 public:
  //! Appends to a file from now on. Without a name, only violations are written, to standard error.
  void open(const std::string& file_name);
  void write(const Json& line);
  //! Counts a call. Violations and notes name it until the next one.
  void begin_call(const char* name);
  void violation(const std::string& kind, const std::string& detail);
  void note(const std::string& kind, const std::string& detail);
  //! Writes the last line and forgets all counts.
  void write_summary(Json counts);
  //! Sets the number of the frame that is in progress.
  void set_frame(std::uint64_t frame) { frame_ = frame; }

 private:
  std::string file_name_;
  std::string call_;
  std::uint64_t frame_ = 0;
  std::uint64_t violations_ = 0;
  std::uint64_t notes_ = 0;
  Json calls_ = Json::object();
};

Log& runtime_log();

//! Logs a violation and throws Failure with the result.
[[noreturn]] void fail(XrResult result, const std::string& kind, const std::string& detail);

//! Returns the pose as position and quaternion: x, y, z [m], qx, qy, qz, qw.
Json json_of(const XrPosef& pose);
//! Returns the angles [rad]: left, right, up, down.
Json json_of(const XrFovf& fov);

}  // namespace ergodome::openxr_test
