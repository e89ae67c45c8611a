#include "tests/support/openxr_runtime/runtime_state.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace ergodome::openxr_test {

bool Runtime::happens_now(const char* mode) { return script.has(mode) && frames >= 30 && happened.insert(mode).second; }

bool Runtime::is_between(const char* mode, std::uint64_t first, std::uint64_t last) const {
  return script.has(mode) && frame() >= first && frame() <= last;
}

Runtime& runtime() {
  // Never destroyed: a program may still call the runtime while it exits.
  static Runtime* const instance = new Runtime;
  return *instance;
}

Session& live_session(XrSession handle) {
  Session& session = runtime().sessions.at(handle);
  if (session.lost) {
    throw Failure{XR_ERROR_SESSION_LOST};
  }
  return session;
}

void require_live_session() {
  for (const auto& [handle, session] : runtime().sessions) {
    if (session.lost) {
      throw Failure{XR_ERROR_SESSION_LOST};
    }
  }
}

Session& running_session(XrSession handle) {
  Session& session = live_session(handle);
  if (!session.running) {
    fail(XR_ERROR_SESSION_NOT_RUNNING, "not_running", "the session has not begun or has ended");
  }
  return session;
}

XrSession only_session() { return runtime().sessions.empty() ? XR_NULL_HANDLE : runtime().sessions.begin()->first; }

void sleep_unlocked(std::chrono::nanoseconds duration) {
  runtime().mutex.unlock();
  std::this_thread::sleep_for(duration);
  runtime().mutex.lock();
}

void check_structure(const void* structure, XrStructureType type, std::initializer_list<XrStructureType> extensions) {
  if (structure == nullptr) {
    fail(XR_ERROR_VALIDATION_FAILURE, "null_pointer", "structure of type " + std::to_string(type));
  }
  const auto* const header = static_cast<const XrBaseInStructure*>(structure);
  if (header->type != type) {
    fail(XR_ERROR_VALIDATION_FAILURE, "structure_type",
         "type is " + std::to_string(header->type) + ", expected " + std::to_string(type));
  }
  for (const XrBaseInStructure* next = header->next; next != nullptr; next = next->next) {
    if (std::find(extensions.begin(), extensions.end(), next->type) == extensions.end()) {
      fail(XR_ERROR_VALIDATION_FAILURE, "next_pointer",
           "a structure of type " + std::to_string(next->type) + " cannot follow type " + std::to_string(type));
    }
  }
}

XrPosef float_pose(const Pose& pose) {
  const auto single = [](double value) { return static_cast<float>(value); };
  return {{single(pose.rotation[0]), single(pose.rotation[1]), single(pose.rotation[2]), single(pose.rotation[3])},
          {single(pose.position[0]), single(pose.position[1]), single(pose.position[2])}};
}

Pose double_pose(const XrPosef& pose) {
  return {{pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w},
          {pose.position.x, pose.position.y, pose.position.z}};
}

void check_pose(const XrPosef& pose, const char* name) {
  const Pose exact = double_pose(pose);
  double squares = 0;
  for (const double component : exact.rotation) {
    squares += component * component;
  }
  const double sum = exact.position[0] + exact.position[1] + exact.position[2];
  if (!std::isfinite(sum) || !(std::abs(squares - 1) < 0.02)) {
    fail(XR_ERROR_POSE_INVALID, "invalid_pose", std::string(name) + ": " + json_of(pose).dump());
  }
}

}  // namespace ergodome::openxr_test
