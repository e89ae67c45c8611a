#pragma once

namespace ergodome {

//! Runs the rest of the program in a child process, and restarts it at once after a crash: a
//! service manager that also has to start the display takes several seconds. Returns only in the
//! child. This process exits with the child's status when the child exits normally, or fails within
//! its first seconds. Forwards signals that request its end. Call it before other threads start.
void restart_after_crashes();

}  // namespace ergodome
