#pragma once

namespace ergodome {

//! From now on Ctrl-C (SIGINT) and SIGTERM only ask for a stop; a second one ends the program at once.
void catch_interrupts();

//! Whether a stop was asked for.
bool interrupted();

}  // namespace ergodome
