#pragma once

namespace ergodome {

//! Throws UsageError where an environment variable of the program (COMMANDS.md lists them) has a value that it does not have, or that this processor does not.
void check_environment();

}  // namespace ergodome
