#pragma once

namespace ergodome {

//! Lets the rest of the program run in a child process, and starts it again at once after a crash: a service manager that has
//! to start the display as well takes several seconds. Returns in the child alone; this process ends when the child ends by
//! itself, or fails within its first seconds, with its exit status. Signals that ask this process to end are passed on.
//! Call it before there are other threads.
void restart_after_crashes();

}  // namespace ergodome
