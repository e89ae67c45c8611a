#pragma once

#include <string>

#include "render/present/headset/openxr_functions.h"

namespace ergodome {

//! Calls functions of an OpenXR runtime. Runtimes may leave another OpenGL context current, so each
//! call restores the one that was current when this object was made.
class OpenXrCalls {
 public:
  OpenXrCalls();

  //! Sets the functions, after an instance was created.
  void set(XrInstance instance, const OpenXrFunctions& functions);

  [[nodiscard]] const OpenXrFunctions& xr() const { return functions_; }

  //! Calls a function and returns its result. `name` is for messages. Throws HeadsetLost if the
  //! session, the instance or the runtime is lost, and Error for other failures.
  template <class Function, class... Arguments>
  XrResult operator()(const char* name, Function function, Arguments... arguments) const {
    return checked(name, ignoring_errors(function, arguments...));
  }

  //! Does the same without throwing.
  template <class Function, class... Arguments>
  XrResult ignoring_errors(Function function, Arguments... arguments) const {
    const XrResult result = function(arguments...);
    restore_context();
    return result;
  }

  void restore_context() const;

  [[nodiscard]] Display* display() const { return display_; }
  [[nodiscard]] GLXContext context() const { return context_; }
  [[nodiscard]] GLXDrawable drawable() const { return drawable_; }

 private:
  XrResult checked(const char* name, XrResult result) const;

  Display* display_;
  GLXDrawable drawable_;
  GLXContext context_;
  XrInstance instance_ = XR_NULL_HANDLE;
  OpenXrFunctions functions_;
};

}  // namespace ergodome
