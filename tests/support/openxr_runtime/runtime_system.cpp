// The headset: its limits and view configurations.
#include <algorithm>
#include <cstring>

#include "tests/support/openxr_runtime/runtime_functions.h"

namespace ergodome::openxr_test {

namespace {

constexpr XrSystemId only_system = 1;

void check_system(XrInstance instance, XrSystemId system) {
  runtime().instances.at(instance);
  if (system != only_system) {
    fail(XR_ERROR_SYSTEM_INVALID, "system", "system " + std::to_string(system) + " does not exist");
  }
}

std::vector<XrViewConfigurationType> offered_views() {
  if (runtime().script.has("mono")) {
    return {XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO};
  }
  if (runtime().extensions.contains(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME)) {
    return {XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
  }
  return {XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
}

}  // namespace

std::uint32_t view_count(XrViewConfigurationType type) {
  const std::vector<XrViewConfigurationType> offered = offered_views();
  if (std::find(offered.begin(), offered.end(), type) == offered.end()) {
    throw Failure{XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED};
  }
  switch (type) {
    case XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO:
      return 1;
    case XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO:
      return 4;
    default:
      return 2;
  }
}

XrResult get_system(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* system) {
  Runtime& state = runtime();
  state.instances.at(instance);
  check_structure(info, XR_TYPE_SYSTEM_GET_INFO);
  if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) {
    return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
  }
  ++state.system_requests;
  if (state.script.has("no_system") || (state.script.has("no_system_at_first") && state.system_requests <= 3)) {
    return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  }
  *system = only_system;
  return XR_SUCCESS;
}

XrResult get_system_properties(XrInstance instance, XrSystemId system, XrSystemProperties* properties) {
  check_system(instance, system);
  check_structure(properties, XR_TYPE_SYSTEM_PROPERTIES);
  properties->systemId = only_system;
  properties->vendorId = 0x1234;
  std::strncpy(properties->systemName, "Ergodome test headset", sizeof properties->systemName - 1);
  const std::uint32_t limit = runtime().script.has("tiny") ? 1 : 8192;
  properties->graphicsProperties = {limit, limit, runtime().script.has("no_layers") ? 0U : 16U};
  properties->trackingProperties = {XR_TRUE, XR_TRUE};
  return XR_SUCCESS;
}

XrResult enumerate_view_configurations(XrInstance instance, XrSystemId system, std::uint32_t capacity,
                                       std::uint32_t* count, XrViewConfigurationType* types) {
  check_system(instance, system);
  return enumerate(offered_views(), capacity, count, types);
}

XrResult get_view_configuration_properties(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                           XrViewConfigurationProperties* properties) {
  check_system(instance, system);
  check_structure(properties, XR_TYPE_VIEW_CONFIGURATION_PROPERTIES);
  view_count(type);
  properties->viewConfigurationType = type;
  properties->fovMutable = XR_FALSE;
  return XR_SUCCESS;
}

XrResult enumerate_view_configuration_views(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                            std::uint32_t capacity, std::uint32_t* count,
                                            XrViewConfigurationView* views) {
  check_system(instance, system);
  const Script& script = runtime().script;
  const std::uint32_t limit = script.has("tiny") ? 1 : 8192;
  const std::vector<XrViewConfigurationView> all(
      view_count(type), {XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, script.width, limit, script.height, limit, 1, 1});
  for (std::uint32_t i = 0; views != nullptr && i < std::min<std::size_t>(capacity, all.size()); ++i) {
    check_structure(&views[i], XR_TYPE_VIEW_CONFIGURATION_VIEW);
  }
  return enumerate(all, capacity, count, views);
}

XrResult enumerate_blend_modes(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                               std::uint32_t capacity, std::uint32_t* count, XrEnvironmentBlendMode* modes) {
  check_system(instance, system);
  view_count(type);
  return enumerate(std::vector{XR_ENVIRONMENT_BLEND_MODE_OPAQUE}, capacity, count, modes);
}

XrResult get_opengl_graphics_requirements(XrInstance instance, XrSystemId system,
                                          XrGraphicsRequirementsOpenGLKHR* requirements) {
  check_system(instance, system);
  check_structure(requirements, XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
  requirements->minApiVersionSupported = XR_MAKE_VERSION(3, 3, 0);
  requirements->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  runtime().has_graphics_requirements = true;
  return XR_SUCCESS;
}

}  // namespace ergodome::openxr_test
