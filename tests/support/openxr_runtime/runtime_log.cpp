#include "tests/support/openxr_runtime/runtime_log.h"

#include <cstdio>
#include <fstream>

namespace ergodome::openxr_test {

void Log::open(const std::string& file_name) { file_name_ = file_name; }

void Log::write(const Json& line) {
  if (file_name_.empty()) {
    if (line.contains("violation")) {
      std::fprintf(stderr, "%s\n", line.dump().c_str());
    }
    return;
  }
  // Opened for each line, so that a log stays complete when the program crashes.
  std::ofstream file(file_name_, std::ios::app);
  file << line.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void Log::begin_call(const char* name) {
  call_ = name;
  calls_[call_] = calls_.value(call_, 0) + 1;
}

void Log::violation(const std::string& kind, const std::string& detail) {
  ++violations_;
  write({{"violation", kind}, {"call", call_}, {"frame", frame_}, {"detail", detail}});
}

void Log::note(const std::string& kind, const std::string& detail) {
  ++notes_;
  write({{"note", kind}, {"call", call_}, {"frame", frame_}, {"detail", detail}});
}

void Log::write_summary(Json counts) {
  counts["violations"] = violations_;
  counts["notes"] = notes_;
  counts["calls"] = calls_;
  write({{"summary", counts}});
  violations_ = notes_ = 0;
  calls_ = Json::object();
}

Log& runtime_log() {
  static Log log;
  return log;
}

void fail(XrResult result, const std::string& kind, const std::string& detail) {
  runtime_log().violation(kind, detail);
  throw Failure{result};
}

Json json_of(const XrPosef& pose) {
  return {pose.position.x,    pose.position.y,    pose.position.z,   pose.orientation.x,
          pose.orientation.y, pose.orientation.z, pose.orientation.w};
}

Json json_of(const XrFovf& fov) { return {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}; }

}  // namespace ergodome::openxr_test
