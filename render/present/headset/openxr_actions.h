#pragma once

#include <array>
#include <cstddef>

#include "render/present/headset/headset_input.h"
#include "render/present/headset/openxr_calls.h"

namespace ergodome {

//! The controllers of a headset: OpenXR's actions and their suggested bindings.
class OpenXrActions {
 public:
  //! Creates the actions and suggests their bindings for the simple, Touch, Index, Vive, Reverb and
  //! hand profiles. Skips profiles that the runtime does not support. `calls` must outlive this.
  //! `library` is for asking which extensions are enabled.
  OpenXrActions(const OpenXrCalls& calls, XrInstance instance, const OpenXrLibrary& library);

  ~OpenXrActions();
  OpenXrActions(const OpenXrActions&) = delete;
  OpenXrActions& operator=(const OpenXrActions&) = delete;

  //! Attaches the actions to a session; once for each session.
  void attach(XrSession session);

  //! Returns the state of both hands' controllers, without dead zones; at rest unless the session
  //! is focused. Call it once per frame.
  [[nodiscard]] HeadsetHands read(XrSession session);

  //! Lets a hand's controller vibrate; 0 is the left one. `strength`: 0 to 1. Does nothing if that
  //! fails.
  void pulse(XrSession session, int hand, double seconds, double strength);

  //! The parts of a controller. Each has an action.
  enum class Part { stick, trigger, grip, lower, upper, stick_press, menu, vibration };
  static constexpr std::size_t part_count = 8;

 private:
  [[nodiscard]] XrPath path_of(XrInstance instance, const char* text) const;
  void create_actions(XrInstance instance);
  void suggest_bindings(XrInstance instance, const OpenXrLibrary& library);
  [[nodiscard]] HeadsetHand read_hand(XrSession session, XrPath hand) const;
  [[nodiscard]] XrActionStateGetInfo state_of(Part part, XrPath hand) const;
  [[nodiscard]] XrAction action(Part part) const { return actions_[static_cast<std::size_t>(part)]; }

  const OpenXrCalls& calls_;
  std::array<XrPath, 2> hands_{};
  XrActionSet set_ = XR_NULL_HANDLE;
  std::array<XrAction, part_count> actions_{};
};

}  // namespace ergodome
