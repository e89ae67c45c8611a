#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "app/navigation/controls/steering.h"
#include "app/playback/transport.h"

namespace ergodome {

//! What a key or a button does, once, when it is pressed.
enum class KeyAction {
  none,
  quit,
  help,
  pause,
  seek_back,
  seek_forward,
  step_back,
  step_forward,
  slower,
  faster,
  usual_speed,
  reverse,
  restart,
  previous_chapter,
  next_chapter,
  loop,
  blackout,
  captions,
  next_language,
  volume_down,
  volume_up,
  exposure_down,
  exposure_up,
  exposure_reset,
  fly,
  return_to_path,
  reset,
  next_flight_mode,
  reverse_orbit,
  let_go,
  next_observer,
  reload,
  full_screen,
  next_view,
  times,
  baseline_smaller,
  baseline_larger,
  baseline_reset,
  convergence_nearer,
  convergence_farther,
  swap_eyes,
  tint_eyes,
  next_layout,
  next_model,
  leave_exhibit
};

//! Who an action is for: visitors with a pad reach theirs without a keyboard.
enum class ActionUser { visitor, presenter };

//! An action as files and the help call it.
struct ActionFacts {
  KeyAction action;
  const char* name;
  ActionUser user;
  const char* inputs;  //!< what it is bound to unless a file says otherwise, with blanks between
  const char* english;
  const char* german;
};

//! All actions that may be bound, in the order of control files. The help groups them itself.
std::span<const ActionFacts> all_actions();

//! A component of steering as files and the help call it.
struct SteerFacts {
  double Steering::*component;
  const char* name;
  const char* inputs;  //!< with a sign or a factor in front
  const char* english;
  const char* german;
};

std::span<const SteerFacts> all_steering();

//! What an action asks of a running show; nothing where it is no matter of the show's transport, or one that takes more than the status to
//! answer (captions).
std::optional<TransportCommand> transport_command(KeyAction action, const PlayerStatus& status);

}  // namespace ergodome
