#pragma once

#include "render/present/headset/headset_input.h"
#include "render/present/headset/openxr_calls.h"

namespace ergodome {

//! The controllers of a headset: OpenXR's actions and their suggested bindings.
class OpenXrActions {
 public:
  //! Creates the actions and suggests their bindings for the simple, Touch, Index, Vive, Reverb and
  //! hand profiles. `calls` must outlive this. `library` is for asking which extensions are enabled.
  OpenXrActions(const OpenXrCalls& calls, XrInstance instance, const OpenXrLibrary& library);

  //! Attaches the actions to a session; once for each session.
  void attach(XrSession session);

  //! Returns the state of both hands' controllers. Call it only while the session is focused.
  [[nodiscard]] HeadsetHands read(XrSession session);

  //! Lets a hand's controller vibrate. `strength`: 0 to 1.
  void pulse(XrSession session, int hand, double seconds, double strength);

 private:
  const OpenXrCalls& calls_;
};

}  // namespace ergodome
