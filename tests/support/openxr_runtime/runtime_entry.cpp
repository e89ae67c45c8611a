// The interface to the loader: negotiation, and a table of all functions.
#include <algorithm>
#include <cstring>
#include <exception>
#include <functional>

#include "tests/support/openxr_runtime/runtime_functions.h"
#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

// openxr_loader_negotiation.h, which Debian 12 lacks.
struct NegotiateLoaderInfo {
  std::uint32_t structure_type;  // 1
  std::uint32_t structure_version;
  std::size_t structure_size;
  std::uint32_t minimum_interface_version;
  std::uint32_t maximum_interface_version;
  XrVersion minimum_api_version;
  XrVersion maximum_api_version;
};

struct NegotiateRuntimeRequest {
  std::uint32_t structure_type;  // 3
  std::uint32_t structure_version;
  std::size_t structure_size;
  std::uint32_t runtime_interface_version;
  XrVersion runtime_api_version;
  PFN_xrGetInstanceProcAddr get_instance_proc_addr;
};

//! Returns whether a function works after the instance is lost: destruction, events and texts.
bool survives_instance_loss(const char* name) {
  return std::strncmp(name, "xrDestroy", 9) == 0 || std::strstr(name, "ToString") != nullptr ||
         std::strcmp(name, "xrPollEvent") == 0 || std::strcmp(name, "xrCreateInstance") == 0 ||
         std::strncmp(name, "xrEnumerateInstance", 19) == 0;
}

XrResult guarded(const char* name, bool touches_gl, const std::function<XrResult()>& function) {
  const std::lock_guard lock(runtime().mutex);
  runtime_log().set_frame(runtime().frame());
  runtime_log().begin_call(name);
  if (runtime().instance_lost && !survives_instance_loss(name)) {
    return XR_ERROR_INSTANCE_LOST;
  }
  XrResult result = XR_ERROR_RUNTIME_FAILURE;
  try {
    result = function();
  } catch (const Failure& failure) {
    result = failure.result;
  } catch (const std::exception& error) {
    runtime_log().violation("runtime_failure", error.what());
  }
  if (touches_gl && runtime().script.has("changes_context")) {
    change_context();
  }
  return result;
}

template <auto function>
struct Call;

template <typename... Arguments, XrResult (*function)(Arguments...)>
struct Call<function> {
  static inline const char* name = "";
  static inline bool touches_gl = false;
  static XRAPI_ATTR XrResult XRAPI_CALL call(Arguments... arguments) {
    return guarded(name, touches_gl, [&] { return function(arguments...); });
  }
};

struct TableEntry {
  const char* name;
  PFN_xrVoidFunction function;
};

template <auto function>
TableEntry entry(const char* name, bool touches_gl = false) {
  Call<function>::name = name;
  Call<function>::touches_gl = touches_gl;
  return {name, reinterpret_cast<PFN_xrVoidFunction>(&Call<function>::call)};
}

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function);

const std::vector<TableEntry>& function_table() {
  constexpr bool touches_gl = true;
  static const std::vector<TableEntry> table = {
      {"xrGetInstanceProcAddr", reinterpret_cast<PFN_xrVoidFunction>(&get_instance_proc_addr)},
      entry<enumerate_extensions>("xrEnumerateInstanceExtensionProperties"),
      entry<enumerate_layers>("xrEnumerateApiLayerProperties"),
      entry<create_instance>("xrCreateInstance"),
      entry<destroy_instance>("xrDestroyInstance"),
      entry<get_instance_properties>("xrGetInstanceProperties"),
      entry<poll_event>("xrPollEvent"),
      entry<result_to_string>("xrResultToString"),
      entry<structure_type_to_string>("xrStructureTypeToString"),
      entry<string_to_path>("xrStringToPath"),
      entry<path_to_string>("xrPathToString"),
      entry<get_system>("xrGetSystem"),
      entry<get_system_properties>("xrGetSystemProperties"),
      entry<enumerate_view_configurations>("xrEnumerateViewConfigurations"),
      entry<get_view_configuration_properties>("xrGetViewConfigurationProperties"),
      entry<enumerate_view_configuration_views>("xrEnumerateViewConfigurationViews"),
      entry<enumerate_blend_modes>("xrEnumerateEnvironmentBlendModes"),
      entry<get_opengl_graphics_requirements>("xrGetOpenGLGraphicsRequirementsKHR"),
      entry<create_session>("xrCreateSession", touches_gl),
      entry<destroy_session>("xrDestroySession", touches_gl),
      entry<begin_session>("xrBeginSession", touches_gl),
      entry<end_session>("xrEndSession", touches_gl),
      entry<request_exit_session>("xrRequestExitSession"),
      entry<wait_frame>("xrWaitFrame", touches_gl),
      entry<begin_frame>("xrBeginFrame", touches_gl),
      entry<end_frame>("xrEndFrame", touches_gl),
      entry<enumerate_reference_spaces>("xrEnumerateReferenceSpaces"),
      entry<create_reference_space>("xrCreateReferenceSpace"),
      entry<get_reference_space_bounds>("xrGetReferenceSpaceBoundsRect"),
      entry<create_action_space>("xrCreateActionSpace"),
      entry<locate_space>("xrLocateSpace"),
      entry<destroy_space>("xrDestroySpace"),
      entry<locate_views>("xrLocateViews"),
      entry<enumerate_swapchain_formats>("xrEnumerateSwapchainFormats", touches_gl),
      entry<create_swapchain>("xrCreateSwapchain", touches_gl),
      entry<destroy_swapchain>("xrDestroySwapchain", touches_gl),
      entry<enumerate_swapchain_images>("xrEnumerateSwapchainImages", touches_gl),
      entry<acquire_swapchain_image>("xrAcquireSwapchainImage", touches_gl),
      entry<wait_swapchain_image>("xrWaitSwapchainImage", touches_gl),
      entry<release_swapchain_image>("xrReleaseSwapchainImage", touches_gl),
      entry<create_action_set>("xrCreateActionSet"),
      entry<destroy_action_set>("xrDestroyActionSet"),
      entry<create_action>("xrCreateAction"),
      entry<destroy_action>("xrDestroyAction"),
      entry<suggest_bindings>("xrSuggestInteractionProfileBindings"),
      entry<attach_action_sets>("xrAttachSessionActionSets"),
      entry<get_current_interaction_profile>("xrGetCurrentInteractionProfile"),
      entry<sync_actions>("xrSyncActions"),
      entry<get_action_boolean>("xrGetActionStateBoolean"),
      entry<get_action_float>("xrGetActionStateFloat"),
      entry<get_action_vector>("xrGetActionStateVector2f"),
      entry<get_action_pose>("xrGetActionStatePose"),
      entry<enumerate_bound_sources>("xrEnumerateBoundSourcesForAction"),
      entry<get_input_source_name>("xrGetInputSourceLocalizedName"),
      entry<apply_haptic_feedback>("xrApplyHapticFeedback"),
      entry<stop_haptic_feedback>("xrStopHapticFeedback")};
  return table;
}

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) {
  if (name == nullptr || function == nullptr) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  *function = nullptr;
  const auto is_wanted = [&](const TableEntry& entry) { return std::strcmp(entry.name, name) == 0; };
  const auto found = std::find_if(function_table().begin(), function_table().end(), is_wanted);
  if (found == function_table().end()) {
    return XR_ERROR_FUNCTION_UNSUPPORTED;
  }
  const bool needs_instance = std::strncmp(name, "xrEnumerateInstance", 19) != 0 &&
                              std::strcmp(name, "xrEnumerateApiLayerProperties") != 0 &&
                              std::strcmp(name, "xrCreateInstance") != 0;
  if (instance == XR_NULL_HANDLE && needs_instance) {
    return XR_ERROR_HANDLE_INVALID;
  }
  if (std::strcmp(name, "xrGetOpenGLGraphicsRequirementsKHR") == 0 &&
      !runtime().extensions.contains(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME)) {
    return XR_ERROR_FUNCTION_UNSUPPORTED;
  }
  *function = found->function;
  return XR_SUCCESS;
}

XrResult negotiate(const NegotiateLoaderInfo* loader, NegotiateRuntimeRequest* request) {
  if (loader == nullptr || request == nullptr || loader->structure_type != 1 || request->structure_type != 3 ||
      loader->structure_size != sizeof *loader || request->structure_size != sizeof *request ||
      loader->minimum_interface_version > 1 || loader->maximum_interface_version < 1) {
    return XR_ERROR_INITIALIZATION_FAILED;
  }
  request->runtime_interface_version = 1;
  request->runtime_api_version = XR_CURRENT_API_VERSION;
  request->get_instance_proc_addr = &get_instance_proc_addr;
  return XR_SUCCESS;
}

}  // namespace

}  // namespace ergodome::openxr_test

// NOLINTNEXTLINE(readability-identifier-naming): the loader looks for this name
extern "C" [[gnu::visibility("default")]] XrResult XRAPI_CALL xrNegotiateLoaderRuntimeInterface(const void* loader,
                                                                                                void* request) {
  using namespace ergodome::openxr_test;
  return negotiate(static_cast<const NegotiateLoaderInfo*>(loader), static_cast<NegotiateRuntimeRequest*>(request));
}
