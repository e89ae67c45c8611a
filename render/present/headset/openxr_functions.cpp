#include "render/present/headset/openxr_functions.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Extensions that are used if the runtime has them: conversion between clocks, and controllers
//! whose bindings are not part of OpenXR 1.0.
constexpr const char* optional_extensions[] = {XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME,
                                               XR_EXT_HP_MIXED_REALITY_CONTROLLER_EXTENSION_NAME,
                                               XR_MSFT_HAND_INTERACTION_EXTENSION_NAME};

PFN_xrGetInstanceProcAddr load_openxr() {
  constexpr const char* file = "libopenxr_loader.so.1";
  // The loader reports a missing runtime in ten lines on stderr; create_instance() reports it in
  // one.
  setenv("XR_LOADER_DEBUG", "none", 0);
  // The library is never closed, because runtimes may leave threads behind that use it.
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  void* const entry = library != nullptr ? dlsym(library, "xrGetInstanceProcAddr") : nullptr;
  if (entry == nullptr) {
    throw Error("headset", "the OpenXR loader (libopenxr_loader.so.1) cannot be loaded",
                "install the package libopenxr-loader1");
  }
  return reinterpret_cast<PFN_xrGetInstanceProcAddr>(entry);
}

template <class Function>
Function function_of(PFN_xrGetInstanceProcAddr get, XrInstance instance, const char* name) {
  PFN_xrVoidFunction function = nullptr;
  return get(instance, name, &function) == XR_SUCCESS ? reinterpret_cast<Function>(function) : nullptr;
}

std::vector<std::string> extensions_of_runtime(PFN_xrGetInstanceProcAddr get) {
  const auto enumerate = function_of<PFN_xrEnumerateInstanceExtensionProperties>(
      get, XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties");
  std::uint32_t count = 0;
  if (enumerate == nullptr || enumerate(nullptr, 0, &count, nullptr) != XR_SUCCESS) {
    throw Error("headset", "no OpenXR runtime is active",
                "start SteamVR, Monado or WiVRn, and make it the active OpenXR runtime");
  }
  std::vector<XrExtensionProperties> found(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 0});
  enumerate(nullptr, count, &count, found.data());
  std::vector<std::string> names;
  std::ranges::transform(found, std::back_inserter(names), [](const auto& each) { return each.extensionName; });
  return names;
}

}  // namespace

OpenXrLibrary::OpenXrLibrary() {
  static const PFN_xrGetInstanceProcAddr loaded = load_openxr();
  get_ = loaded;
}

XrInstance OpenXrLibrary::create_instance() {
  const std::vector<std::string> offered = extensions_of_runtime(get_);
  const auto offers = [&](const char* name) { return std::ranges::find(offered, name) != offered.end(); };
  if (!offers(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME)) {
    throw Error("headset", "the active OpenXR runtime does not support OpenGL",
                "choose another runtime, such as SteamVR or Monado");
  }
  enabled_ = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME};
  std::ranges::copy_if(optional_extensions, std::back_inserter(enabled_), offers);
  std::vector<const char*> names;
  std::ranges::transform(enabled_, std::back_inserter(names), [](const std::string& name) { return name.c_str(); });
  auto wanted = openxr_struct<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
  std::snprintf(wanted.applicationInfo.applicationName, sizeof wanted.applicationInfo.applicationName, "Ergodome");
  wanted.applicationInfo.applicationVersion = 1;
  wanted.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  wanted.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
  wanted.enabledExtensionNames = names.data();
  const auto create = function_of<PFN_xrCreateInstance>(get_, XR_NULL_HANDLE, "xrCreateInstance");
  XrInstance instance = XR_NULL_HANDLE;
  const XrResult result = create != nullptr ? create(&wanted, &instance) : XR_ERROR_RUNTIME_UNAVAILABLE;
  if (XR_FAILED(result)) {
    throw Error("headset", fmt::format("the OpenXR runtime does not start (error {})", static_cast<int>(result)),
                "start SteamVR, Monado or WiVRn, and make it the active OpenXR runtime");
  }
  return instance;
}

OpenXrFunctions OpenXrLibrary::functions(XrInstance instance) const {
  OpenXrFunctions found;
#define ERGO_LOAD(name) found.name = function_of<PFN_xr##name>(get_, instance, "xr" #name);
#define ERGO_REQUIRE(name)                                                                          \
  if (found.name == nullptr) {                                                                      \
    throw Error("headset", "the OpenXR runtime lacks the function xr" #name, "update the runtime"); \
  }
  ERGO_OPENXR_FUNCTIONS(ERGO_LOAD)
  ERGO_OPENXR_FUNCTIONS(ERGO_REQUIRE)
  // Layers return functions of extensions that are not enabled, which crash when they are called.
  if (enabled(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME)) {
    ERGO_LOAD(ConvertTimespecTimeToTimeKHR)
  }
#undef ERGO_REQUIRE
#undef ERGO_LOAD
  return found;
}

bool OpenXrLibrary::enabled(const std::string& extension) const {
  return std::ranges::find(enabled_, extension) != enabled_.end();
}

}  // namespace ergodome
