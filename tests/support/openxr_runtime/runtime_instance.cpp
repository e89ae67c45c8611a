// Instances, their extensions, texts and paths.
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>

#include "tests/support/openxr_runtime/runtime_functions.h"
#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

std::vector<std::pair<const char*, std::uint32_t>> offered_extensions() {
  std::vector<std::pair<const char*, std::uint32_t>> extensions = {
      {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME, XR_KHR_opengl_enable_SPEC_VERSION},
      {XR_EXT_HP_MIXED_REALITY_CONTROLLER_EXTENSION_NAME, XR_EXT_hp_mixed_reality_controller_SPEC_VERSION}};
  if (runtime().script.has("quad")) {
    extensions.emplace_back(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME, XR_VARJO_quad_views_SPEC_VERSION);
  }
  return extensions;
}

//! Parses the environment variable. A new text also resets what outlives an instance.
void read_script() {
  const char* const text = std::getenv("ERGODOME_OPENXR_TEST");
  Runtime& state = runtime();
  const std::string script_text = text == nullptr ? "" : text;
  if (script_text != state.script_text) {
    state.system_requests = 0;
  }
  if (script_text != state.script_text || state.frames == 0) {
    state.script_text = script_text;
    state.script = parse_script(script_text);
    state.frames = state.frames_with_layers = state.pictures = state.foreign_contexts = 0;
    state.display_time_ns = state.jumped_ns = 0;
    state.recentered_ns.reset();
    state.happened.clear();
  }
}

//! Copies a text into an array of characters, with its end.
void copy_text(const std::string& text, char* buffer, std::size_t size) {
  std::strncpy(buffer, text.c_str(), size - 1);
  buffer[size - 1] = '\0';
}

bool is_path(const char* text) {
  const std::string path = text;
  const auto is_good = [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0 || std::isdigit(static_cast<unsigned char>(c)) != 0 ||
           std::strchr("-_./", c) != nullptr;
  };
  return path.size() > 1 && path.size() < XR_MAX_PATH_LENGTH && path.front() == '/' && path.back() != '/' &&
         path.find("//") == std::string::npos && std::all_of(path.begin(), path.end(), is_good);
}

//! Reports children that the program has not destroyed, and destroys them.
void destroy_children() {
  Runtime& state = runtime();
  if (!state.sessions.empty() || !state.action_sets.empty()) {
    runtime_log().violation("destroy_order", "the instance is destroyed before its sessions or action sets");
  }
  for (auto& [handle, session] : state.sessions) {
    destroy_other_context(session);
  }
  state.sessions.clear();
  state.swapchains.clear();
  state.spaces.clear();
  state.action_sets.clear();
  state.actions.clear();
  state.bindings.clear();
  state.paths.clear();
  state.events.clear();
  state.extensions.clear();
}

}  // namespace

XrResult enumerate_extensions(const char* layer, std::uint32_t capacity, std::uint32_t* count,
                              XrExtensionProperties* properties) {
  if (layer != nullptr && *layer != '\0') {
    return XR_ERROR_API_LAYER_NOT_PRESENT;
  }
  if (!runtime().has_instance) {
    read_script();
  }
  std::vector<XrExtensionProperties> offered;
  for (const auto& [name, version] : offered_extensions()) {
    XrExtensionProperties extension{XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, version};
    copy_text(name, extension.extensionName, sizeof extension.extensionName);
    offered.push_back(extension);
  }
  for (std::uint32_t i = 0; properties != nullptr && i < std::min<std::size_t>(capacity, offered.size()); ++i) {
    check_structure(&properties[i], XR_TYPE_EXTENSION_PROPERTIES);
  }
  return enumerate(offered, capacity, count, properties);
}

XrResult enumerate_layers(std::uint32_t capacity, std::uint32_t* count, XrApiLayerProperties* properties) {
  return enumerate(std::vector<XrApiLayerProperties>(), capacity, count, properties);
}

XrResult create_instance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  Runtime& state = runtime();
  if (state.has_instance) {
    fail(XR_ERROR_LIMIT_REACHED, "second_instance", "the first instance is not destroyed");
  }
  read_script();
  runtime_log().open(state.script.log_file);
  for (const std::string& error : state.script.errors) {
    runtime_log().violation("script", error);
  }
  check_structure(info, XR_TYPE_INSTANCE_CREATE_INFO, {XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT});
  const XrVersion version = info->applicationInfo.apiVersion;
  if (XR_VERSION_MAJOR(version) != 1 || XR_VERSION_MINOR(version) != 0) {
    return XR_ERROR_API_VERSION_UNSUPPORTED;
  }
  Json extensions = Json::array();
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
    const std::string name = info->enabledExtensionNames[i];
    const auto is_it = [&](const auto& offered) { return name == offered.first; };
    const auto offered = offered_extensions();
    if (std::none_of(offered.begin(), offered.end(), is_it)) {
      state.extensions.clear();
      return XR_ERROR_EXTENSION_NOT_PRESENT;
    }
    state.extensions.insert(name);
    extensions.push_back(name);
  }
  state.has_instance = true;
  state.instance_lost = false;
  state.has_graphics_requirements = false;
  *instance = state.instances.add('\0');
  runtime_log().write({{"instance", std::string(info->applicationInfo.applicationName)}, {"extensions", extensions}});
  return XR_SUCCESS;
}

XrResult destroy_instance(XrInstance instance) {
  Runtime& state = runtime();
  state.instances.at(instance);
  destroy_children();
  state.instances.remove(instance);
  state.has_instance = false;
  state.instance_lost = false;
  runtime_log().write_summary({{"frames", state.frames},
                               {"frames_with_layers", state.frames_with_layers},
                               {"pictures", state.pictures},
                               {"foreign_contexts", state.foreign_contexts}});
  return XR_SUCCESS;
}

XrResult get_instance_properties(XrInstance instance, XrInstanceProperties* properties) {
  runtime().instances.at(instance);
  check_structure(properties, XR_TYPE_INSTANCE_PROPERTIES);
  properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  copy_text("Ergodome test runtime", properties->runtimeName, sizeof properties->runtimeName);
  return XR_SUCCESS;
}

#define ERGO_NAME_CASE(name, value) \
  case name:                        \
    copy_text(#name, buffer, size); \
    return XR_SUCCESS;

XrResult result_to_string(XrInstance instance, XrResult value, char* buffer) {
  runtime().instances.at(instance);
  constexpr std::size_t size = XR_MAX_RESULT_STRING_SIZE;
  switch (value) {
    XR_LIST_ENUM_XrResult(ERGO_NAME_CASE) default
        : copy_text((value < 0 ? "XR_UNKNOWN_FAILURE_" : "XR_UNKNOWN_SUCCESS_") + std::to_string(value), buffer, size);
  }
  return XR_SUCCESS;
}

XrResult structure_type_to_string(XrInstance instance, XrStructureType value, char* buffer) {
  runtime().instances.at(instance);
  constexpr std::size_t size = XR_MAX_STRUCTURE_NAME_SIZE;
  switch (value) {
    XR_LIST_ENUM_XrStructureType(ERGO_NAME_CASE) default
        : copy_text("XR_UNKNOWN_STRUCTURE_TYPE_" + std::to_string(value), buffer, size);
  }
  return XR_SUCCESS;
}

#undef ERGO_NAME_CASE

XrResult string_to_path(XrInstance instance, const char* text, XrPath* path) {
  runtime().instances.at(instance);
  if (text == nullptr || !is_path(text)) {
    fail(XR_ERROR_PATH_FORMAT_INVALID, "path_format", text == nullptr ? "null" : text);
  }
  *path = path_of(text);
  return XR_SUCCESS;
}

XrResult path_to_string(XrInstance instance, XrPath path, std::uint32_t capacity, std::uint32_t* count, char* buffer) {
  runtime().instances.at(instance);
  const std::string& text = path_text(path);
  return enumerate(std::vector<char>(text.c_str(), text.c_str() + text.size() + 1), capacity, count, buffer);
}

}  // namespace ergodome::openxr_test
