#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/openxr_runtime/openxr_glx.h"
#include "tests/support/openxr_runtime/runtime_log.h"
#include "tests/support/openxr_runtime/runtime_script.h"
#include "tests/support/openxr_runtime/test_head.h"

namespace ergodome::openxr_test {

struct Swapchain {
  XrSwapchainCreateInfo info{};
  std::vector<GLuint> textures;
  std::deque<std::uint32_t> acquired;
  std::uint32_t next_image = 0;
  //! The oldest acquired image was waited for.
  bool waited = false;
  //! The rest of a slow wait that timed out.
  std::optional<std::int64_t> wait_left_ns;
  std::optional<std::uint32_t> released;
  //! The frame in which the image was released.
  std::uint64_t released_frame = 0;
};

//! A reference space, or the space of an action if `action` is set.
struct Space {
  XrReferenceSpaceType type = XR_REFERENCE_SPACE_TYPE_VIEW;
  XrAction action = XR_NULL_HANDLE;
  XrPath subaction = XR_NULL_PATH;
  Pose offset;
};

struct ActionSet {
  std::string name;
  bool attached = false;
};

struct Action {
  XrActionSet set = XR_NULL_HANDLE;
  std::string name;
  XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT;
  std::vector<XrPath> subactions;
};

//! A call of xrLocateViews: what it returned.
struct LocatedViews {
  XrSpace space = XR_NULL_HANDLE;
  bool valid = true;
  std::vector<XrView> views;
};

struct Session {
  XrGraphicsBindingOpenGLXlibKHR binding{};
  //! The context that the mode `changes_context` leaves current.
  GLXContext other_context = nullptr;
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  //! The last state that the program has polled.
  XrSessionState polled_state = XR_SESSION_STATE_UNKNOWN;
  bool running = false;
  bool lost = false;
  bool exits = false;
  std::chrono::steady_clock::time_point created;
  XrViewConfigurationType views = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  //! Display times that xrWaitFrame returned and xrBeginFrame has not yet taken.
  std::deque<XrTime> waited;
  std::optional<XrTime> begun;
  std::map<XrTime, bool> should_render;
  std::multimap<XrTime, LocatedViews> located;
  bool actions_attached = false;
  bool profile_announced = false;
  std::set<XrActionSet> synced_sets;
  std::map<std::string, float> inputs;
  std::map<std::string, float> inputs_before;
};

//! Objects of one kind, by handle.
template <typename Handle, typename Object>
class Handles {
 public:
  Handle add(Object object);
  //! Returns the object; fails with XR_ERROR_HANDLE_INVALID if the handle has none.
  Object& at(Handle handle) {
    const auto found = objects_.find(handle);
    if (found == objects_.end()) {
      fail(XR_ERROR_HANDLE_INVALID, "handle", "the handle was never created or is already destroyed");
    }
    return found->second;
  }
  void remove(Handle handle) { objects_.erase(handle); }
  void clear() { objects_.clear(); }
  [[nodiscard]] bool has(Handle handle) const { return objects_.contains(handle); }
  [[nodiscard]] bool empty() const { return objects_.empty(); }
  auto begin() { return objects_.begin(); }
  auto end() { return objects_.end(); }

 private:
  std::map<Handle, Object> objects_;
};

//! The instance and all its objects. OpenXR allows more than one instance; this runtime does not.
struct Runtime {
  std::mutex mutex;
  Script script;
  std::string script_text;
  bool has_instance = false;
  bool instance_lost = false;
  std::set<std::string> extensions;
  bool has_graphics_requirements = false;
  std::deque<XrEventDataBuffer> events;
  Handles<XrInstance, char> instances;
  Handles<XrSession, Session> sessions;
  Handles<XrSwapchain, Swapchain> swapchains;
  Handles<XrSpace, Space> spaces;
  Handles<XrActionSet, ActionSet> action_sets;
  Handles<XrAction, Action> actions;
  std::vector<std::string> paths;
  //! Suggested bindings by interaction profile.
  std::map<std::string, std::vector<std::pair<XrAction, std::string>>> bindings;

  // These outlive an instance, until another script is set.
  std::uint64_t frames = 0;
  std::uint64_t frames_with_layers = 0;
  std::uint64_t pictures = 0;
  std::uint64_t foreign_contexts = 0;
  std::uint64_t system_requests = 0;
  std::uint64_t handles = 0x1000;
  XrTime display_time_ns = 0;
  XrTime jumped_ns = 0;
  //! When STAGE and LOCAL move in the mode `recenter`.
  std::optional<XrTime> recentered_ns;
  //! Modes that happen once and have happened.
  std::set<std::string> happened;

  //! Returns true once, in or after frame 30, if the script has the mode.
  bool happens_now(const char* mode);
  [[nodiscard]] bool is_between(const char* mode, std::uint64_t first, std::uint64_t last) const;
  //! The frame in progress; the first one is 1.
  [[nodiscard]] std::uint64_t frame() const { return frames + 1; }
};

Runtime& runtime();

template <typename Handle, typename Object>
Handle Handles<Handle, Object>::add(Object object) {
  const auto handle = reinterpret_cast<Handle>(++runtime().handles);  // NOLINT(performance-no-int-to-ptr)
  objects_.emplace(handle, std::move(object));
  return handle;
}

//! Returns a session that is not lost.
Session& live_session(XrSession handle);
//! Fails with XR_ERROR_SESSION_LOST if the only session is lost.
void require_live_session();
//! Returns a session between xrBeginSession and xrEndSession.
Session& running_session(XrSession handle);
XrSession only_session();

//! Lets other threads call the runtime while this thread sleeps.
void sleep_unlocked(std::chrono::nanoseconds duration);

//! Checks the type and the chain of `next` of a structure. Structures of `extensions` may follow it.
void check_structure(const void* structure, XrStructureType type,
                     std::initializer_list<XrStructureType> extensions = {});

XrPosef float_pose(const Pose& pose);
Pose double_pose(const XrPosef& pose);
//! Fails with XR_ERROR_POSE_INVALID if the quaternion does not have unit length or a number is not finite.
void check_pose(const XrPosef& pose, const char* name);

//! Copies values by OpenXR's two calls: first the count, then the values.
template <typename Value>
XrResult enumerate(const std::vector<Value>& values, std::uint32_t capacity, std::uint32_t* count, Value* output) {
  if (count == nullptr || (capacity > 0 && output == nullptr)) {
    fail(XR_ERROR_VALIDATION_FAILURE, "null_pointer", "count or array");
  }
  *count = static_cast<std::uint32_t>(values.size());
  if (capacity == 0) {
    return XR_SUCCESS;
  }
  if (capacity < values.size()) {
    return XR_ERROR_SIZE_INSUFFICIENT;
  }
  std::copy(values.begin(), values.end(), output);
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
