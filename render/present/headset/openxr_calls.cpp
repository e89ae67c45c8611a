#include "render/present/headset/openxr_calls.h"

#include <fmt/format.h>

#include "kernels/core/error.h"
#include "render/present/headset/headset_session.h"

namespace ergodome {

OpenXrCalls::OpenXrCalls()
    : display_(glXGetCurrentDisplay()), drawable_(glXGetCurrentDrawable()), context_(glXGetCurrentContext()) {
  if (display_ == nullptr || context_ == nullptr) {
    throw Error("headset", "the window does not use GLX, which OpenXR needs here",
                "run the program under X11 or XWayland");
  }
}

void OpenXrCalls::set(XrInstance instance, const OpenXrFunctions& functions) {
  instance_ = instance;
  functions_ = functions;
}

void OpenXrCalls::restore_context() const {
  if (glXGetCurrentContext() != context_ || glXGetCurrentDrawable() != drawable_) {
    glXMakeCurrent(display_, drawable_, context_);
  }
}

XrResult OpenXrCalls::checked(const char* name, XrResult result) const {
  if (XR_SUCCEEDED(result)) {
    return result;
  }
  char text[XR_MAX_RESULT_STRING_SIZE] = {};
  if (functions_.ResultToString == nullptr || functions_.ResultToString(instance_, result, text) != XR_SUCCESS) {
    fmt::format_to_n(text, sizeof text - 1, "error {}", static_cast<int>(result));
  }
  const std::string problem = fmt::format("{} failed: {}", name, text);
  switch (result) {
    case XR_ERROR_SESSION_LOST:
    case XR_ERROR_INSTANCE_LOST:
    case XR_ERROR_RUNTIME_FAILURE:
    case XR_ERROR_RUNTIME_UNAVAILABLE:
      throw HeadsetLost(problem);
    case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
    case XR_ERROR_FORM_FACTOR_UNSUPPORTED:
      throw Error("headset", "no headset is connected", "connect the headset and switch it on");
    default:
      throw Error("headset", problem, "restart the OpenXR runtime, and report the error if it remains");
  }
}

}  // namespace ergodome
