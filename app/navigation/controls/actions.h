#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "app/navigation/controls/steering.h"
#include "app/playback/transport.h"

namespace ergodome {

//! Actions of a key or button, performed once when it is pressed.
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

//! Who may use an action in an exhibit: also visitors, or only presenters. The defaults bind every
//! action of visitors to a button of a controller.
enum class ActionUser { visitor, presenter };

//! Names of an action in files and in the help.
struct ActionNames {
  KeyAction action;
  const char* name;
  ActionUser user;
  const char* inputs;  //!< default inputs, separated by blanks
  const char* english;
  const char* german;
};

//! Returns all actions that may be bound, in the order of control files. The help groups them
//! itself.
std::span<const ActionNames> all_actions();

//! Names of a steering component in files and in the help.
struct SteerNames {
  double Steering::*component;
  const char* name;
  const char* inputs;  //!< default inputs, separated by blanks, some with a sign or factor in front
  const char* english;
  const char* german;
};

std::span<const SteerNames> all_steering();

//! Returns the transport command of an action. Returns nothing if the action does not concern the
//! transport, and for `captions`, which the session switches itself.
std::optional<TransportCommand> transport_command(KeyAction action, const PlayerStatus& status);

}  // namespace ergodome
