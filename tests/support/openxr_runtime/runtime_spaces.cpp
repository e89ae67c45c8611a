// Reference spaces, spaces of actions, and the poses of head and eyes in them.
#include <algorithm>

#include "tests/support/openxr_runtime/runtime_functions.h"

namespace ergodome::openxr_test {

namespace {

std::vector<XrReferenceSpaceType> offered_spaces() {
  if (runtime().script.has("no_stage")) {
    return {XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  }
  return {XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_STAGE};
}

//! Returns the pose of a space in the original STAGE space, or nothing if it is not tracked.
std::optional<Pose> pose_of(const Space& space, XrTime time) {
  if (space.action != XR_NULL_HANDLE) {
    const std::vector<std::string> paths = bound_paths(space.action, space.subaction);
    if (paths.empty()) {
      return std::nullopt;
    }
    const int hand = paths.front().find("/right/") == std::string::npos ? 0 : 1;
    const bool aims = paths.front().find("/aim/") != std::string::npos;
    return compose(hand_in_stage(hand, aims, time), space.offset);
  }
  if (space.type == XR_REFERENCE_SPACE_TYPE_VIEW) {
    return compose(head_in_stage(time), space.offset);
  }
  Pose origin = space.type == XR_REFERENCE_SPACE_TYPE_LOCAL ? local_in_stage() : Pose{};
  if (runtime().recentered_ns && time >= *runtime().recentered_ns) {
    origin = compose(origin, recentered_space());
  }
  return compose(origin, space.offset);
}

void check_time(XrTime time) {
  if (time <= 0) {
    fail(XR_ERROR_TIME_INVALID, "time", "the time is not positive");
  }
}

//! Returns the view of an eye in a space. Views 2 and 3 of quad views are the insets of the eyes.
XrView located_view(const Pose& base, std::uint32_t index, std::uint32_t count, XrTime time) {
  const int eye = static_cast<int>(index % 2);
  const Pose in_head = count == 1 ? Pose{} : eye_in_head(eye, runtime().script.interpupillary_distance_m);
  const Pose pose = compose(inverse(base), compose(head_in_stage(time), in_head));
  const FieldOfView fov = field_of_view(eye, time);
  const double scale = index < 2 ? 1 : 0.4;
  const auto angle = [&](double radians) { return static_cast<float>(scale * radians); };
  return {XR_TYPE_VIEW, nullptr, float_pose(pose), {angle(fov.left), angle(fov.right), angle(fov.up), angle(fov.down)}};
}

}  // namespace

std::string space_name(const Space& space) {
  if (space.action != XR_NULL_HANDLE) {
    return "ACTION";
  }
  switch (space.type) {
    case XR_REFERENCE_SPACE_TYPE_VIEW:
      return "VIEW";
    case XR_REFERENCE_SPACE_TYPE_LOCAL:
      return "LOCAL";
    default:
      return "STAGE";
  }
}

XrResult enumerate_reference_spaces(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                    XrReferenceSpaceType* types) {
  live_session(session);
  return enumerate(offered_spaces(), capacity, count, types);
}

XrResult create_reference_space(XrSession session, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
  live_session(session);
  check_structure(info, XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
  check_pose(info->poseInReferenceSpace, "space");
  const std::vector<XrReferenceSpaceType> offered = offered_spaces();
  if (std::find(offered.begin(), offered.end(), info->referenceSpaceType) == offered.end()) {
    return XR_ERROR_REFERENCE_SPACE_UNSUPPORTED;
  }
  Space created;
  created.type = info->referenceSpaceType;
  created.offset = double_pose(info->poseInReferenceSpace);
  *space = runtime().spaces.add(created);
  return XR_SUCCESS;
}

XrResult get_reference_space_bounds(XrSession session, XrReferenceSpaceType type, XrExtent2Df* bounds) {
  live_session(session);
  const bool has_bounds = type == XR_REFERENCE_SPACE_TYPE_STAGE && !runtime().script.has("no_stage");
  *bounds = has_bounds ? XrExtent2Df{3, 2} : XrExtent2Df{0, 0};
  return has_bounds ? XR_SUCCESS : XR_SPACE_BOUNDS_UNAVAILABLE;
}

XrResult create_action_space(XrSession session, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  live_session(session);
  check_structure(info, XR_TYPE_ACTION_SPACE_CREATE_INFO);
  check_pose(info->poseInActionSpace, "space");
  if (runtime().actions.at(info->action).type != XR_ACTION_TYPE_POSE_INPUT) {
    fail(XR_ERROR_ACTION_TYPE_MISMATCH, "action_type", "only a pose has a space");
  }
  Space created;
  created.action = info->action;
  created.subaction = info->subactionPath;
  created.offset = double_pose(info->poseInActionSpace);
  *space = runtime().spaces.add(created);
  return XR_SUCCESS;
}

XrResult locate_space(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  require_live_session();
  check_structure(location, XR_TYPE_SPACE_LOCATION, {XR_TYPE_SPACE_VELOCITY});
  check_time(time);
  const std::optional<Pose> pose = pose_of(runtime().spaces.at(space), time);
  const std::optional<Pose> base_pose = pose_of(runtime().spaces.at(base), time);
  location->locationFlags = 0;
  location->pose = float_pose({});
  if (location->next != nullptr) {
    static_cast<XrSpaceVelocity*>(location->next)->velocityFlags = 0;
  }
  if (pose && base_pose) {
    location->locationFlags = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
                              XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
    location->pose = float_pose(compose(inverse(*base_pose), *pose));
  }
  return XR_SUCCESS;
}

XrResult destroy_space(XrSpace space) {
  runtime().spaces.at(space);
  runtime().spaces.remove(space);
  return XR_SUCCESS;
}

XrResult locate_views(XrSession handle, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                      std::uint32_t* count, XrView* views) {
  Session& session = live_session(handle);
  check_structure(info, XR_TYPE_VIEW_LOCATE_INFO);
  check_structure(state, XR_TYPE_VIEW_STATE);
  check_time(info->displayTime);
  const std::uint32_t all = view_count(info->viewConfigurationType);
  const std::optional<Pose> base = pose_of(runtime().spaces.at(info->space), info->displayTime);
  LocatedViews located;
  located.space = info->space;
  located.valid = base.has_value() && !runtime().is_between("invalid_poses", 20, 40);
  for (std::uint32_t i = 0; i < all; ++i) {
    located.views.push_back(located_view(base.value_or(Pose{}), i, all, info->displayTime));
    if (!located.valid) {
      // A pose without its valid bits is undefined: this one shows up wherever a program uses it.
      located.views.back().pose = {};
    }
  }
  state->viewStateFlags = located.valid ? XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT |
                                              XR_VIEW_STATE_ORIENTATION_TRACKED_BIT | XR_VIEW_STATE_POSITION_TRACKED_BIT
                                        : 0;
  for (std::uint32_t i = 0; views != nullptr && i < std::min(capacity, all); ++i) {
    check_structure(&views[i], XR_TYPE_VIEW);
  }
  const XrResult result = enumerate(located.views, capacity, count, views);
  if (capacity > 0 && result == XR_SUCCESS) {
    session.located.emplace(info->displayTime, located);
  }
  return result;
}

}  // namespace ergodome::openxr_test
