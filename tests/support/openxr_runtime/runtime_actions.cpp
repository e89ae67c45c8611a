// Action sets, actions and their bindings.
#include <algorithm>
#include <cctype>
#include <cstring>

#include "tests/support/openxr_runtime/runtime_functions.h"

namespace ergodome::openxr_test {

namespace {

void check_name(const std::string& name, const std::string& localized) {
  const auto is_good = [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0 || std::isdigit(static_cast<unsigned char>(c)) != 0 ||
           c == '-' || c == '_' || c == '.';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_good)) {
    fail(XR_ERROR_PATH_FORMAT_INVALID, "action_name", "not a valid name: " + name);
  }
  if (localized.empty()) {
    fail(XR_ERROR_LOCALIZED_NAME_INVALID, "action_name", name + " has no localized name");
  }
}

bool is_attached(XrActionSet set) { return runtime().action_sets.at(set).attached; }

}  // namespace

const std::string& path_text(XrPath path) {
  if (path == XR_NULL_PATH || path > runtime().paths.size()) {
    fail(XR_ERROR_PATH_INVALID, "path", "path " + std::to_string(path) + " does not exist");
  }
  return runtime().paths[path - 1];
}

XrPath path_of(const std::string& text) {
  std::vector<std::string>& paths = runtime().paths;
  const auto found = std::find(paths.begin(), paths.end(), text);
  const auto index = static_cast<XrPath>(found - paths.begin());
  if (found == paths.end()) {
    paths.push_back(text);
  }
  return index + 1;
}

bool has_current_profile() { return runtime().bindings.contains(runtime().script.profile); }

std::vector<std::string> bound_paths(XrAction action, XrPath subaction) {
  std::vector<std::string> paths;
  const auto bindings = runtime().bindings.find(runtime().script.profile);
  if (bindings == runtime().bindings.end()) {
    return paths;
  }
  const std::string prefix = subaction == XR_NULL_PATH ? "" : path_text(subaction) + "/";
  for (const auto& [bound, path] : bindings->second) {
    if (bound == action && path.compare(0, prefix.size(), prefix) == 0) {
      paths.push_back(path);
    }
  }
  return paths;
}

XrResult create_action_set(XrInstance instance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  runtime().instances.at(instance);
  check_structure(info, XR_TYPE_ACTION_SET_CREATE_INFO);
  check_name(info->actionSetName, info->localizedActionSetName);
  *set = runtime().action_sets.add({info->actionSetName, false});
  return XR_SUCCESS;
}

XrResult destroy_action_set(XrActionSet set) {
  Runtime& state = runtime();
  state.action_sets.at(set);
  for (const auto& [handle, action] : state.actions) {
    if (action.set == set) {
      runtime_log().violation("destroy_order", "the action set is destroyed before its action " + action.name);
    }
  }
  state.action_sets.remove(set);
  return XR_SUCCESS;
}

XrResult create_action(XrActionSet set, const XrActionCreateInfo* info, XrAction* action) {
  check_structure(info, XR_TYPE_ACTION_CREATE_INFO);
  if (is_attached(set)) {
    fail(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "action_order", "the action set is already attached");
  }
  check_name(info->actionName, info->localizedActionName);
  Action created{set, info->actionName, info->actionType, {}};
  for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i) {
    path_text(info->subactionPaths[i]);
    created.subactions.push_back(info->subactionPaths[i]);
  }
  for (const auto& [handle, other] : runtime().actions) {
    if (other.set == set && other.name == created.name) {
      fail(XR_ERROR_NAME_DUPLICATED, "action_name", "two actions are named " + created.name);
    }
  }
  *action = runtime().actions.add(created);
  return XR_SUCCESS;
}

XrResult destroy_action(XrAction action) {
  runtime().actions.at(action);
  runtime().actions.remove(action);
  return XR_SUCCESS;
}

XrResult suggest_bindings(XrInstance instance, const XrInteractionProfileSuggestedBinding* suggested) {
  runtime().instances.at(instance);
  check_structure(suggested, XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
  const std::string profile = path_text(suggested->interactionProfile);
  if (!has_profile(profile)) {
    runtime_log().note("profile", "unknown interaction profile " + profile);
    return XR_ERROR_PATH_UNSUPPORTED;
  }
  std::vector<std::pair<XrAction, std::string>> bindings;
  Json lines = Json::array();
  for (std::uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
    const XrActionSuggestedBinding& binding = suggested->suggestedBindings[i];
    const std::string path = path_text(binding.binding);
    const Action& action = runtime().actions.at(binding.action);
    if (is_attached(action.set)) {
      fail(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "action_order", "the action set is already attached");
    }
    if (!has_component(profile, path)) {
      fail(XR_ERROR_PATH_UNSUPPORTED, "binding", std::string("the profile has no component ").append(path));
    }
    bindings.emplace_back(binding.action, path);
    lines.push_back({{"action", action.name}, {"path", path}});
  }
  runtime().bindings[profile] = bindings;
  runtime_log().write({{"bindings", profile}, {"actions", lines}});
  return XR_SUCCESS;
}

XrResult attach_action_sets(XrSession handle, const XrSessionActionSetsAttachInfo* info) {
  Session& session = live_session(handle);
  check_structure(info, XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  if (session.actions_attached) {
    fail(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "action_order", "action sets are already attached to the session");
  }
  for (std::uint32_t i = 0; i < info->countActionSets; ++i) {
    runtime().action_sets.at(info->actionSets[i]).attached = true;
  }
  session.actions_attached = true;
  return XR_SUCCESS;
}

XrResult get_current_interaction_profile(XrSession handle, XrPath top_level, XrInteractionProfileState* state) {
  const Session& session = live_session(handle);
  check_structure(state, XR_TYPE_INTERACTION_PROFILE_STATE);
  if (!session.actions_attached) {
    fail(XR_ERROR_ACTIONSET_NOT_ATTACHED, "action_order", "no action set is attached");
  }
  const std::string& user = path_text(top_level);
  const bool is_hand = user == "/user/hand/left" || user == "/user/hand/right";
  // Known only after the first synchronization, like in other runtimes.
  const bool is_known = is_hand && session.profile_announced && has_current_profile();
  state->interactionProfile = is_known ? path_of(runtime().script.profile) : XR_NULL_PATH;
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
