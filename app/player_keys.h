#pragma once

#include <string>

#include "app/navigation/actions.h"

namespace ergodome {

//! The action of a key without modifiers in the program's own map, by GLFW's number; left, right, up, down, in and out for keys that steer.
KeyAction action_of(int key);

//! The keys, a line each, for --help.
std::string key_help();

}  // namespace ergodome
