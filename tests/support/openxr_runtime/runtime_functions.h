#pragma once

#include <cstring>

#include "tests/support/openxr_runtime/runtime_state.h"

// The runtime's functions, named like OpenXR's. runtime_entry.cpp counts and guards their calls.
namespace ergodome::openxr_test {

// runtime_instance.cpp
XrResult enumerate_extensions(const char* layer, std::uint32_t capacity, std::uint32_t* count,
                              XrExtensionProperties* properties);
XrResult enumerate_layers(std::uint32_t capacity, std::uint32_t* count, XrApiLayerProperties* properties);
XrResult create_instance(const XrInstanceCreateInfo* info, XrInstance* instance);
XrResult destroy_instance(XrInstance instance);
XrResult get_instance_properties(XrInstance instance, XrInstanceProperties* properties);
XrResult result_to_string(XrInstance instance, XrResult value, char* buffer);
XrResult structure_type_to_string(XrInstance instance, XrStructureType value, char* buffer);
XrResult string_to_path(XrInstance instance, const char* text, XrPath* path);
XrResult path_to_string(XrInstance instance, XrPath path, std::uint32_t capacity, std::uint32_t* count, char* buffer);

// runtime_system.cpp
XrResult get_system(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* system);
XrResult get_system_properties(XrInstance instance, XrSystemId system, XrSystemProperties* properties);
XrResult enumerate_view_configurations(XrInstance instance, XrSystemId system, std::uint32_t capacity,
                                       std::uint32_t* count, XrViewConfigurationType* types);
XrResult get_view_configuration_properties(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                           XrViewConfigurationProperties* properties);
XrResult enumerate_view_configuration_views(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                            std::uint32_t capacity, std::uint32_t* count,
                                            XrViewConfigurationView* views);
XrResult enumerate_blend_modes(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                               std::uint32_t capacity, std::uint32_t* count, XrEnvironmentBlendMode* modes);
XrResult get_opengl_graphics_requirements(XrInstance instance, XrSystemId system,
                                          XrGraphicsRequirementsOpenGLKHR* requirements);
//! Returns how many views a configuration has; fails with XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED.
std::uint32_t view_count(XrViewConfigurationType type);

// runtime_session.cpp
XrResult create_session(XrInstance instance, const XrSessionCreateInfo* info, XrSession* session);
XrResult destroy_session(XrSession session);
XrResult begin_session(XrSession session, const XrSessionBeginInfo* info);
XrResult end_session(XrSession session);
XrResult request_exit_session(XrSession session);

// runtime_events.cpp
XrResult poll_event(XrInstance instance, XrEventDataBuffer* event);
void queue_state(Session& session, XrSessionState state);
//! Queues the events of a frame that was submitted, and starts what the script's modes do at it.
void advance_state(Session& session);
template <typename Event>
void queue_event(const Event& event) {
  static_assert(sizeof(Event) <= sizeof(XrEventDataBuffer));
  XrEventDataBuffer buffer{};
  std::memcpy(&buffer, &event, sizeof event);
  runtime().events.push_back(buffer);
}

// runtime_frames.cpp
XrResult wait_frame(XrSession session, const XrFrameWaitInfo* info, XrFrameState* state);
XrResult begin_frame(XrSession session, const XrFrameBeginInfo* info);
XrResult end_frame(XrSession session, const XrFrameEndInfo* info);

// runtime_layers.cpp
//! Checks the layers of a frame and returns what the log says about them.
Json check_layers(Session& session, const XrFrameEndInfo& info);

// runtime_spaces.cpp
XrResult enumerate_reference_spaces(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                    XrReferenceSpaceType* types);
XrResult create_reference_space(XrSession session, const XrReferenceSpaceCreateInfo* info, XrSpace* space);
XrResult get_reference_space_bounds(XrSession session, XrReferenceSpaceType type, XrExtent2Df* bounds);
XrResult create_action_space(XrSession session, const XrActionSpaceCreateInfo* info, XrSpace* space);
XrResult locate_space(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location);
XrResult destroy_space(XrSpace space);
XrResult locate_views(XrSession session, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                      std::uint32_t* count, XrView* views);
std::string space_name(const Space& space);

// runtime_swapchains.cpp
XrResult enumerate_swapchain_formats(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                     std::int64_t* formats);
XrResult create_swapchain(XrSession session, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain);
XrResult destroy_swapchain(XrSwapchain swapchain);
XrResult enumerate_swapchain_images(XrSwapchain swapchain, std::uint32_t capacity, std::uint32_t* count,
                                    XrSwapchainImageBaseHeader* images);
XrResult acquire_swapchain_image(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo* info, std::uint32_t* index);
XrResult wait_swapchain_image(XrSwapchain swapchain, const XrSwapchainImageWaitInfo* info);
XrResult release_swapchain_image(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo* info);

// runtime_actions.cpp
XrResult create_action_set(XrInstance instance, const XrActionSetCreateInfo* info, XrActionSet* set);
XrResult destroy_action_set(XrActionSet set);
XrResult create_action(XrActionSet set, const XrActionCreateInfo* info, XrAction* action);
XrResult destroy_action(XrAction action);
XrResult suggest_bindings(XrInstance instance, const XrInteractionProfileSuggestedBinding* suggested);
XrResult attach_action_sets(XrSession session, const XrSessionActionSetsAttachInfo* info);
XrResult get_current_interaction_profile(XrSession session, XrPath top_level, XrInteractionProfileState* state);
//! Returns the text of a path; fails with XR_ERROR_PATH_INVALID.
const std::string& path_text(XrPath path);
XrPath path_of(const std::string& text);
//! Returns whether the controllers follow the profile, for which the program suggested bindings.
bool has_current_profile();
//! Returns the paths that the current profile binds to an action, of one hand if `subaction` is set.
std::vector<std::string> bound_paths(XrAction action, XrPath subaction);

// runtime_input.cpp
XrResult sync_actions(XrSession session, const XrActionsSyncInfo* info);
XrResult get_action_boolean(XrSession session, const XrActionStateGetInfo* info, XrActionStateBoolean* state);
XrResult get_action_float(XrSession session, const XrActionStateGetInfo* info, XrActionStateFloat* state);
XrResult get_action_vector(XrSession session, const XrActionStateGetInfo* info, XrActionStateVector2f* state);
XrResult get_action_pose(XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state);
XrResult enumerate_bound_sources(XrSession session, const XrBoundSourcesForActionEnumerateInfo* info,
                                 std::uint32_t capacity, std::uint32_t* count, XrPath* sources);
XrResult get_input_source_name(XrSession session, const XrInputSourceLocalizedNameGetInfo* info, std::uint32_t capacity,
                               std::uint32_t* count, char* buffer);
XrResult apply_haptic_feedback(XrSession session, const XrHapticActionInfo* info, const XrHapticBaseHeader* feedback);
XrResult stop_haptic_feedback(XrSession session, const XrHapticActionInfo* info);

// runtime_profiles.cpp
//! Returns whether an interaction profile is known; HP's only if its extension is enabled.
bool has_profile(const std::string& profile);
//! Returns whether a binding is a component of a profile or the parent of one, for example `.../input/thumbstick`.
bool has_component(const std::string& profile, const std::string& path);

}  // namespace ergodome::openxr_test
