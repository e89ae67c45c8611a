#pragma once

#include <string>

namespace ergodome {

//! What a key does while a show is playing.
enum class KeyAction {
  none,
  quit,
  pause,
  seek_back,
  seek_forward,
  restart,
  fly,
  full_screen,
  next_view,
  times,
  left,
  right,
  up,
  down,
  in,
  out,
  baseline_smaller,
  baseline_larger,
  baseline_reset,
  convergence_nearer,
  convergence_farther,
  swap_eyes,
  tint_eyes,
  next_layout,
  next_model
};

//! The action of a key, by GLFW's number.
KeyAction action_of(int key);

//! The keys, a line each, for --help.
std::string key_help();

}  // namespace ergodome
