#include "render/present/headset/openxr_actions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

namespace {

using Part = OpenXrActions::Part;

constexpr std::array<const char*, 2> hand_paths = {"/user/hand/left", "/user/hand/right"};

//! An action and its names: for bindings, and for the runtime's list of bindings.
struct NamedAction {
  XrActionType type;
  const char* name;
  const char* label;
};

//! The actions, in the order of `Part`.
constexpr std::array<NamedAction, OpenXrActions::part_count> named_actions = {
    {{XR_ACTION_TYPE_VECTOR2F_INPUT, "stick", "Stick"},
     {XR_ACTION_TYPE_FLOAT_INPUT, "trigger", "Trigger"},
     {XR_ACTION_TYPE_FLOAT_INPUT, "grip", "Grip"},
     {XR_ACTION_TYPE_BOOLEAN_INPUT, "lower_button", "Lower button"},
     {XR_ACTION_TYPE_BOOLEAN_INPUT, "upper_button", "Upper button"},
     {XR_ACTION_TYPE_BOOLEAN_INPUT, "stick_press", "Press of the stick"},
     {XR_ACTION_TYPE_BOOLEAN_INPUT, "recenter", "Recenter"},
     {XR_ACTION_TYPE_VIBRATION_OUTPUT, "vibration", "Vibration"}}};

enum class Hands { left, right, both };

//! A component of a controller that a part is bound to. Runtimes convert between Boolean and
//! float components and actions.
struct Binding {
  Part part;
  Hands hands;
  const char* component;
};

//! Bindings for one kind of controller.
struct Profile {
  const char* path;
  const char* extension;  //!< extension that defines the profile; nullptr: OpenXR 1.0
  std::span<const Binding> bindings;
};

// Component paths are those of the OpenXR 1.0 specification, section 6.4, and of the extensions.

// A simple controller selects like a trigger, so that it moves the camera as a pinch does.
constexpr Binding simple_controller[] = {
    {Part::trigger, Hands::both, "/input/select/click"},
    {Part::menu, Hands::both, "/input/menu/click"},
    {Part::vibration, Hands::both, "/output/haptic"},
};

// The menu button of the right hand belongs to the system.
constexpr Binding touch_controller[] = {
    {Part::stick, Hands::both, "/input/thumbstick"},   {Part::trigger, Hands::both, "/input/trigger/value"},
    {Part::grip, Hands::both, "/input/squeeze/value"}, {Part::lower, Hands::left, "/input/x/click"},
    {Part::lower, Hands::right, "/input/a/click"},     {Part::upper, Hands::left, "/input/y/click"},
    {Part::upper, Hands::right, "/input/b/click"},     {Part::stick_press, Hands::both, "/input/thumbstick/click"},
    {Part::menu, Hands::left, "/input/menu/click"},    {Part::vibration, Hands::both, "/output/haptic"},
};

// The squeeze value is 1 in a hand that only holds the controller, so the force counts. There is no
// menu button: the trackpad, pressed firmly, replaces it.
constexpr Binding index_controller[] = {
    {Part::stick, Hands::both, "/input/thumbstick"},    {Part::trigger, Hands::both, "/input/trigger/value"},
    {Part::grip, Hands::both, "/input/squeeze/force"},  {Part::lower, Hands::both, "/input/a/click"},
    {Part::upper, Hands::both, "/input/b/click"},       {Part::stick_press, Hands::both, "/input/thumbstick/click"},
    {Part::menu, Hands::both, "/input/trackpad/force"}, {Part::vibration, Hands::both, "/output/haptic"},
};

constexpr Binding vive_controller[] = {
    {Part::stick, Hands::both, "/input/trackpad"},     {Part::trigger, Hands::both, "/input/trigger/value"},
    {Part::grip, Hands::both, "/input/squeeze/click"}, {Part::stick_press, Hands::both, "/input/trackpad/click"},
    {Part::menu, Hands::both, "/input/menu/click"},    {Part::vibration, Hands::both, "/output/haptic"},
};

constexpr Binding reverb_controller[] = {
    {Part::stick, Hands::both, "/input/thumbstick"},   {Part::trigger, Hands::both, "/input/trigger/value"},
    {Part::grip, Hands::both, "/input/squeeze/value"}, {Part::lower, Hands::left, "/input/x/click"},
    {Part::lower, Hands::right, "/input/a/click"},     {Part::upper, Hands::left, "/input/y/click"},
    {Part::upper, Hands::right, "/input/b/click"},     {Part::stick_press, Hands::both, "/input/thumbstick/click"},
    {Part::menu, Hands::both, "/input/menu/click"},    {Part::vibration, Hands::both, "/output/haptic"},
};

// Some runtimes take a pinch for a squeeze too, so that is not bound.
constexpr Binding tracked_hand[] = {
    {Part::trigger, Hands::both, "/input/select/value"},
};

constexpr Profile profiles[] = {
    {"/interaction_profiles/khr/simple_controller", nullptr, simple_controller},
    {"/interaction_profiles/oculus/touch_controller", nullptr, touch_controller},
    {"/interaction_profiles/valve/index_controller", nullptr, index_controller},
    {"/interaction_profiles/htc/vive_controller", nullptr, vive_controller},
    {"/interaction_profiles/hp/mixed_reality_controller", XR_EXT_HP_MIXED_REALITY_CONTROLLER_EXTENSION_NAME,
     reverb_controller},
    {"/interaction_profiles/microsoft/hand_interaction", XR_MSFT_HAND_INTERACTION_EXTENSION_NAME, tracked_hand},
};

bool is_bound_in(Hands hands, std::size_t hand) {
  return hands == Hands::both || (hands == Hands::left) == (hand == 0);
}

//! Limits a value of the runtime to `low` to 1; 0 if it is not a number.
double limited(float value, double low) {
  return std::isfinite(value) ? std::clamp(static_cast<double>(value), low, 1.0) : 0.0;
}

}  // namespace

OpenXrActions::OpenXrActions(const OpenXrCalls& calls, XrInstance instance, const OpenXrLibrary& library)
    : calls_(calls) {
  create_actions(instance);
  suggest_bindings(instance, library);
}

XrPath OpenXrActions::path_of(XrInstance instance, const char* text) const {
  XrPath path = XR_NULL_PATH;
  calls_("xrStringToPath", calls_.xr().StringToPath, instance, text, &path);
  return path;
}

void OpenXrActions::create_actions(XrInstance instance) {
  std::ranges::transform(hand_paths, hands_.begin(), [&](const char* hand) { return path_of(instance, hand); });
  auto set = openxr_struct<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
  std::snprintf(set.actionSetName, sizeof set.actionSetName, "flight");
  std::snprintf(set.localizedActionSetName, sizeof set.localizedActionSetName, "Flight");
  calls_("xrCreateActionSet", calls_.xr().CreateActionSet, instance, &set, &set_);
  for (std::size_t i = 0; i < part_count; ++i) {
    auto wanted = openxr_struct<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    std::snprintf(wanted.actionName, sizeof wanted.actionName, "%s", named_actions[i].name);
    std::snprintf(wanted.localizedActionName, sizeof wanted.localizedActionName, "%s", named_actions[i].label);
    wanted.actionType = named_actions[i].type;
    wanted.countSubactionPaths = static_cast<std::uint32_t>(hands_.size());
    wanted.subactionPaths = hands_.data();
    calls_("xrCreateAction", calls_.xr().CreateAction, set_, &wanted, &actions_[i]);
  }
}

void OpenXrActions::suggest_bindings(XrInstance instance, const OpenXrLibrary& library) {
  for (const Profile& profile : profiles) {
    if (profile.extension != nullptr && !library.enabled(profile.extension)) {
      continue;
    }
    std::vector<XrActionSuggestedBinding> bindings;
    for (const Binding& binding : profile.bindings) {
      for (std::size_t hand = 0; hand < hand_paths.size(); ++hand) {
        if (is_bound_in(binding.hands, hand)) {
          const std::string path = std::string(hand_paths[hand]) + binding.component;
          bindings.push_back({action(binding.part), path_of(instance, path.c_str())});
        }
      }
    }
    auto suggested = openxr_struct<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    suggested.interactionProfile = path_of(instance, profile.path);
    suggested.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
    suggested.suggestedBindings = bindings.data();
    const auto suggest = [&] {
      const XrResult result = calls_.xr().SuggestInteractionProfileBindings(instance, &suggested);
      return result == XR_ERROR_PATH_UNSUPPORTED ? XR_SUCCESS : result;
    };
    calls_("xrSuggestInteractionProfileBindings", suggest);
  }
}

OpenXrActions::~OpenXrActions() {
  for (const XrAction action : actions_) {
    calls_.ignoring_errors(calls_.xr().DestroyAction, action);
  }
  calls_.ignoring_errors(calls_.xr().DestroyActionSet, set_);
}

void OpenXrActions::attach(XrSession session) {
  auto attached = openxr_struct<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  attached.countActionSets = 1;
  attached.actionSets = &set_;
  calls_("xrAttachSessionActionSets", calls_.xr().AttachSessionActionSets, session, &attached);
}

HeadsetHands OpenXrActions::read(XrSession session) {
  const XrActiveActionSet active{set_, XR_NULL_PATH};
  auto sync = openxr_struct<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
  sync.countActiveActionSets = 1;
  sync.activeActionSets = &active;
  // The session may have lost the focus since the last event.
  if (calls_("xrSyncActions", calls_.xr().SyncActions, session, &sync) != XR_SUCCESS) {
    return {};
  }
  return {read_hand(session, hands_[0]), read_hand(session, hands_[1])};
}

XrActionStateGetInfo OpenXrActions::state_of(Part part, XrPath hand) const {
  return {XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action(part), hand};
}

HeadsetHand OpenXrActions::read_hand(XrSession session, XrPath hand) const {
  const OpenXrFunctions& xr = calls_.xr();
  HeadsetHand read;
  // A part is active while a controller that has it is connected.
  const auto number = [&](Part part) {
    const XrActionStateGetInfo wanted = state_of(part, hand);
    auto state = openxr_struct<XrActionStateFloat>(XR_TYPE_ACTION_STATE_FLOAT);
    calls_("xrGetActionStateFloat", xr.GetActionStateFloat, session, &wanted, &state);
    read.connected = read.connected || state.isActive == XR_TRUE;
    return state.isActive == XR_TRUE ? limited(state.currentState, 0.0) : 0.0;
  };
  const auto pressed = [&](Part part) {
    const XrActionStateGetInfo wanted = state_of(part, hand);
    auto state = openxr_struct<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
    calls_("xrGetActionStateBoolean", xr.GetActionStateBoolean, session, &wanted, &state);
    read.connected = read.connected || state.isActive == XR_TRUE;
    return state.isActive == XR_TRUE && state.currentState == XR_TRUE;
  };
  const XrActionStateGetInfo wanted = state_of(Part::stick, hand);
  auto stick = openxr_struct<XrActionStateVector2f>(XR_TYPE_ACTION_STATE_VECTOR2F);
  calls_("xrGetActionStateVector2f", xr.GetActionStateVector2f, session, &wanted, &stick);
  if (stick.isActive == XR_TRUE) {
    read.connected = true;
    read.stick_x = limited(stick.currentState.x, -1.0);
    read.stick_y = limited(stick.currentState.y, -1.0);
  }
  read.trigger = number(Part::trigger);
  read.grip = number(Part::grip);
  read.lower = pressed(Part::lower);
  read.upper = pressed(Part::upper);
  read.stick = pressed(Part::stick_press);
  read.menu = pressed(Part::menu);
  read.has_stick = stick.isActive == XR_TRUE || !read.connected;
  return read;
}

void OpenXrActions::pulse(XrSession session, int hand, double seconds, double strength) {
  auto wanted = openxr_struct<XrHapticActionInfo>(XR_TYPE_HAPTIC_ACTION_INFO);
  wanted.action = action(Part::vibration);
  wanted.subactionPath = hands_.at(static_cast<std::size_t>(hand));
  auto vibration = openxr_struct<XrHapticVibration>(XR_TYPE_HAPTIC_VIBRATION);
  vibration.duration = std::max<XrDuration>(1, std::llround(1e9 * seconds));
  vibration.frequency = XR_FREQUENCY_UNSPECIFIED;
  vibration.amplitude = static_cast<float>(std::clamp(strength, 0.0, 1.0));
  calls_.ignoring_errors(calls_.xr().ApplyHapticFeedback, session, &wanted,
                         reinterpret_cast<const XrHapticBaseHeader*>(&vibration));
}

}  // namespace ergodome
