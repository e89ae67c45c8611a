// Interaction profiles and their components, from the OpenXR specification, section 6.4.
#include <map>
#include <string>

#include "tests/support/openxr_runtime/runtime_functions.h"

namespace ergodome::openxr_test {

namespace {

//! Components of a profile, separated by spaces.
struct Profile {
  const char* both;
  const char* left;
  const char* right;
};

// "grip/pose", "aim/pose" and "haptic" belong to every profile.
const std::map<std::string, Profile> known_profiles = {
    {"/interaction_profiles/khr/simple_controller", {"select/click menu/click", "", ""}},
    {"/interaction_profiles/oculus/touch_controller",
     {"squeeze/value trigger/value trigger/touch thumbstick/x thumbstick/y thumbstick/click thumbstick/touch "
      "thumbrest/touch",
      "x/click x/touch y/click y/touch menu/click", "a/click a/touch b/click b/touch system/click"}},
    {"/interaction_profiles/valve/index_controller",
     {"system/click system/touch a/click a/touch b/click b/touch squeeze/value squeeze/force trigger/click "
      "trigger/value trigger/touch thumbstick/x thumbstick/y thumbstick/click thumbstick/touch trackpad/x trackpad/y "
      "trackpad/force trackpad/touch",
      "", ""}},
    {"/interaction_profiles/htc/vive_controller",
     {"system/click squeeze/click menu/click trigger/click trigger/value trackpad/x trackpad/y trackpad/click "
      "trackpad/touch",
      "", ""}},
    {"/interaction_profiles/microsoft/motion_controller",
     {"menu/click squeeze/click trigger/value thumbstick/x thumbstick/y thumbstick/click trackpad/x trackpad/y "
      "trackpad/click trackpad/touch",
      "", ""}},
    {"/interaction_profiles/hp/mixed_reality_controller",
     {"menu/click squeeze/value trigger/value thumbstick/x thumbstick/y thumbstick/click", "x/click y/click",
      "a/click b/click"}}};

//! Returns whether the list has the component, or a component of which it is the parent.
bool lists(const std::string& components, const std::string& component) {
  const std::string list = " " + components + " ";
  return list.find(" " + component + " ") != std::string::npos || list.find(" " + component + "/") != std::string::npos;
}

}  // namespace

bool has_profile(const std::string& profile) {
  return known_profiles.contains(profile) &&
         (profile != "/interaction_profiles/hp/mixed_reality_controller" ||
          runtime().extensions.contains(XR_EXT_HP_MIXED_REALITY_CONTROLLER_EXTENSION_NAME));
}

bool has_component(const std::string& profile, const std::string& path) {
  const Profile& found = known_profiles.at(profile);
  for (const bool is_left : {true, false}) {
    const std::string hand = is_left ? "/user/hand/left/" : "/user/hand/right/";
    if (path.compare(0, hand.size(), hand) != 0) {
      continue;
    }
    const std::string rest = path.substr(hand.size());
    if (rest == "output/haptic") {
      return true;
    }
    const std::string input = "input/";
    return rest.compare(0, input.size(), input) == 0 &&
           lists(std::string("grip/pose aim/pose ") + found.both + " " + (is_left ? found.left : found.right),
                 rest.substr(input.size()));
  }
  return false;
}

}  // namespace ergodome::openxr_test
