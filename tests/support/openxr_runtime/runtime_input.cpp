// Synchronizes actions with the input script and reports their states; logs haptic feedback.
#include <algorithm>
#include <cmath>

#include "tests/support/openxr_runtime/runtime_functions.h"

namespace ergodome::openxr_test {

namespace {

using Inputs = std::map<std::string, float>;

//! Returns the value of a bound path: of the component itself, or of `value` or `click` of its parent.
float input_value(const Inputs& inputs, const std::string& path) {
  for (const char* const ending : {"", "/value", "/click", "/force"}) {
    const auto found = inputs.find(path + ending);
    if (found != inputs.end()) {
      return found->second;
    }
  }
  return 0;
}

//! Returns the value of largest magnitude among the paths, with an ending such as "/x".
float largest_value(const Inputs& inputs, const std::vector<std::string>& paths, const std::string& ending) {
  float largest = 0;
  for (const std::string& path : paths) {
    const float value = input_value(inputs, path + ending);
    largest = std::abs(value) > std::abs(largest) ? value : largest;
  }
  return largest;
}

//! Checks the request for an action's state and returns the paths that give it.
std::vector<std::string> checked_paths(const Session& session, const XrActionStateGetInfo* info, XrActionType type) {
  check_structure(info, XR_TYPE_ACTION_STATE_GET_INFO);
  const Action& action = runtime().actions.at(info->action);
  if (action.type != type) {
    fail(XR_ERROR_ACTION_TYPE_MISMATCH, "action_type", action.name + " has another type");
  }
  if (!runtime().action_sets.at(action.set).attached) {
    fail(XR_ERROR_ACTIONSET_NOT_ATTACHED, "action_order", "the set of " + action.name + " is not attached");
  }
  if (info->subactionPath != XR_NULL_PATH &&
      std::find(action.subactions.begin(), action.subactions.end(), info->subactionPath) == action.subactions.end()) {
    fail(XR_ERROR_PATH_UNSUPPORTED, "subaction",
         action.name + " was created without " + path_text(info->subactionPath));
  }
  if (session.state != XR_SESSION_STATE_FOCUSED || !session.synced_sets.contains(action.set)) {
    return {};
  }
  return bound_paths(info->action, info->subactionPath);
}

//! Fills in what all states except poses have in common.
template <typename State>
void set_activity(State& state, bool is_active, bool has_changed) {
  state.isActive = is_active ? XR_TRUE : XR_FALSE;
  state.changedSinceLastSync = is_active && has_changed ? XR_TRUE : XR_FALSE;
  state.lastChangeTime = is_active && has_changed ? runtime().display_time_ns : 0;
}

void log_haptic(const XrHapticActionInfo* info, const XrHapticVibration* vibration) {
  check_structure(info, XR_TYPE_HAPTIC_ACTION_INFO);
  const Action& action = runtime().actions.at(info->action);
  if (action.type != XR_ACTION_TYPE_VIBRATION_OUTPUT) {
    fail(XR_ERROR_ACTION_TYPE_MISMATCH, "action_type", action.name + " is not a vibration");
  }
  Json line = {{"haptic", vibration == nullptr ? "stop" : "apply"},
               {"action", action.name},
               {"paths", bound_paths(info->action, info->subactionPath)},
               {"frame", runtime().frame()}};
  if (vibration != nullptr) {
    line.update({{"amplitude", vibration->amplitude},
                 {"duration_ns", vibration->duration},
                 {"frequency_hz", vibration->frequency}});
  }
  runtime_log().write(line);
}

}  // namespace

XrResult sync_actions(XrSession handle, const XrActionsSyncInfo* info) {
  Session& session = live_session(handle);
  check_structure(info, XR_TYPE_ACTIONS_SYNC_INFO);
  session.synced_sets.clear();
  for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i) {
    const XrActionSet set = info->activeActionSets[i].actionSet;
    if (!runtime().action_sets.at(set).attached) {
      fail(XR_ERROR_ACTIONSET_NOT_ATTACHED, "action_order", "the action set is not attached");
    }
    session.synced_sets.insert(set);
  }
  if (!std::exchange(session.profile_announced, true) && has_current_profile()) {
    queue_event(XrEventDataInteractionProfileChanged{XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED, nullptr, handle});
  }
  session.inputs_before = session.inputs;
  session.inputs = runtime().script.inputs_at(runtime().frame());
  if (session.polled_state != XR_SESSION_STATE_FOCUSED) {
    runtime_log().violation("sync_without_focus", "the last state that was polled is not FOCUSED");
  }
  return session.state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

XrResult get_action_boolean(XrSession handle, const XrActionStateGetInfo* info, XrActionStateBoolean* state) {
  const Session& session = live_session(handle);
  check_structure(state, XR_TYPE_ACTION_STATE_BOOLEAN);
  const std::vector<std::string> paths = checked_paths(session, info, XR_ACTION_TYPE_BOOLEAN_INPUT);
  const bool is_on = largest_value(session.inputs, paths, "") > 0.5F;
  const bool was_on = largest_value(session.inputs_before, paths, "") > 0.5F;
  state->currentState = is_on ? XR_TRUE : XR_FALSE;
  set_activity(*state, !paths.empty(), is_on != was_on);
  return XR_SUCCESS;
}

XrResult get_action_float(XrSession handle, const XrActionStateGetInfo* info, XrActionStateFloat* state) {
  const Session& session = live_session(handle);
  check_structure(state, XR_TYPE_ACTION_STATE_FLOAT);
  const std::vector<std::string> paths = checked_paths(session, info, XR_ACTION_TYPE_FLOAT_INPUT);
  state->currentState = largest_value(session.inputs, paths, "");
  set_activity(*state, !paths.empty(), state->currentState != largest_value(session.inputs_before, paths, ""));
  return XR_SUCCESS;
}

XrResult get_action_vector(XrSession handle, const XrActionStateGetInfo* info, XrActionStateVector2f* state) {
  const Session& session = live_session(handle);
  check_structure(state, XR_TYPE_ACTION_STATE_VECTOR2F);
  const std::vector<std::string> paths = checked_paths(session, info, XR_ACTION_TYPE_VECTOR2F_INPUT);
  const auto vector = [&](const Inputs& inputs) {
    return XrVector2f{largest_value(inputs, paths, "/x"), largest_value(inputs, paths, "/y")};
  };
  const XrVector2f before = vector(session.inputs_before);
  state->currentState = vector(session.inputs);
  set_activity(*state, !paths.empty(), state->currentState.x != before.x || state->currentState.y != before.y);
  return XR_SUCCESS;
}

XrResult get_action_pose(XrSession handle, const XrActionStateGetInfo* info, XrActionStatePose* state) {
  const Session& session = live_session(handle);
  check_structure(state, XR_TYPE_ACTION_STATE_POSE);
  state->isActive = checked_paths(session, info, XR_ACTION_TYPE_POSE_INPUT).empty() ? XR_FALSE : XR_TRUE;
  return XR_SUCCESS;
}

XrResult enumerate_bound_sources(XrSession session, const XrBoundSourcesForActionEnumerateInfo* info,
                                 std::uint32_t capacity, std::uint32_t* count, XrPath* sources) {
  live_session(session);
  check_structure(info, XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
  std::vector<XrPath> paths;
  for (const std::string& path : bound_paths(info->action, XR_NULL_PATH)) {
    paths.push_back(path_of(path));
  }
  return enumerate(paths, capacity, count, sources);
}

XrResult get_input_source_name(XrSession session, const XrInputSourceLocalizedNameGetInfo* info, std::uint32_t capacity,
                               std::uint32_t* count, char* buffer) {
  live_session(session);
  check_structure(info, XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO);
  const std::string& text = path_text(info->sourcePath);
  return enumerate(std::vector<char>(text.c_str(), text.c_str() + text.size() + 1), capacity, count, buffer);
}

XrResult apply_haptic_feedback(XrSession session, const XrHapticActionInfo* info, const XrHapticBaseHeader* feedback) {
  live_session(session);
  check_structure(feedback, XR_TYPE_HAPTIC_VIBRATION);
  log_haptic(info, reinterpret_cast<const XrHapticVibration*>(feedback));
  return XR_SUCCESS;
}

XrResult stop_haptic_feedback(XrSession session, const XrHapticActionInfo* info) {
  live_session(session);
  log_haptic(info, nullptr);
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
