#pragma once

#include <epoxy/gl.h>
// OpenXR's platform header needs the types of OpenGL and X11.
#include <epoxy/glx.h>
#define XR_NO_PROTOTYPES
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
#include <time.h>

#include <string>
#include <vector>

// OpenXR's functions, loaded at run time. Only sources of this folder include this header, because
// the macros of X11 (None, Bool, Status) do not fit into other sources.

namespace ergodome {

// clang-format off
//! Lists the functions that a session calls.
#define ERGO_OPENXR_FUNCTIONS(X)                                                                             \
  X(DestroyInstance) X(GetInstanceProperties) X(PollEvent) X(ResultToString) X(StringToPath) X(PathToString)  \
  X(GetSystem) X(GetSystemProperties) X(EnumerateViewConfigurations) X(EnumerateViewConfigurationViews)       \
  X(GetOpenGLGraphicsRequirementsKHR) X(CreateSession) X(DestroySession) X(BeginSession) X(EndSession)        \
  X(EnumerateReferenceSpaces) X(CreateReferenceSpace) X(DestroySpace)                                         \
  X(EnumerateSwapchainFormats) X(CreateSwapchain) X(DestroySwapchain) X(EnumerateSwapchainImages)             \
  X(AcquireSwapchainImage) X(WaitSwapchainImage) X(ReleaseSwapchainImage)                                     \
  X(WaitFrame) X(BeginFrame) X(LocateViews) X(EndFrame)                                                       \
  X(CreateActionSet) X(DestroyActionSet) X(CreateAction) X(DestroyAction) X(SuggestInteractionProfileBindings)                 \
  X(AttachSessionActionSets) X(SyncActions) X(GetActionStateBoolean) X(GetActionStateFloat)                   \
  X(GetActionStateVector2f) X(ApplyHapticFeedback) X(GetCurrentInteractionProfile)
// clang-format on

//! The functions of a loaded OpenXR runtime, named without their prefix "xr".
struct OpenXrFunctions {
#define ERGO_MEMBER(name) PFN_xr##name name = nullptr;
  ERGO_OPENXR_FUNCTIONS(ERGO_MEMBER)
  //! nullptr unless the runtime has XR_KHR_convert_timespec_time.
  ERGO_MEMBER(ConvertTimespecTimeToTimeKHR)
#undef ERGO_MEMBER
};

//! Returns a structure of OpenXR with its type set and everything else 0.
template <class Struct>
Struct openxr_struct(XrStructureType type) {
  Struct made{};  // NOLINT(bugprone-invalid-enum-default-initialization): 0 is "not set" in OpenXR
  made.type = type;
  return made;
}

//! OpenXR's loader. The first object loads it; it stays loaded until the program ends.
class OpenXrLibrary {
 public:
  //! Throws Error if the loader is not installed.
  OpenXrLibrary();

  //! Creates an instance with the extension for OpenGL and the optional ones that the runtime
  //! supports. Throws Error if there is no runtime, or if it does not support OpenGL.
  XrInstance create_instance();

  //! Returns the functions of an instance. Throws Error if one is missing.
  [[nodiscard]] OpenXrFunctions functions(XrInstance instance) const;

  //! Returns whether the last instance was created with an extension.
  [[nodiscard]] bool enabled(const std::string& extension) const;

 private:
  PFN_xrGetInstanceProcAddr get_ = nullptr;
  std::vector<std::string> enabled_;
};

}  // namespace ergodome
