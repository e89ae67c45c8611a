#pragma once

#include <string>

namespace ergodome {

//! Notifies the service manager (systemd, Type=notify) that the program is ready. Does nothing
//! without a service manager.
void notify_supervisor_ready();

//! Notifies the service manager, at most once a second, that the program is alive. Call it once per
//! frame: if notices stop, systemd restarts the program.
void notify_supervisor_alive(double now_s);

//! Sets the status line of `systemctl status` if it has changed.
void notify_supervisor(std::string status);

//! Runs the rest of the program in a child process, and starts another when a child ends by a
//! signal or with a nonzero status: a service manager that also has to start the display takes
//! several seconds. Returns only in the child. This process ends with the child's status if the
//! child succeeds, fails within five seconds, or was asked to stop by a signal, which this process
//! forwards. Call it before other threads start. Throws Error if no child can be started.
void restart_after_crashes();

}  // namespace ergodome
