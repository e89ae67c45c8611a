#pragma once

#include <string>

namespace ergodome {

//! Notifies the service manager (systemd, Type=notify) that the program is ready. Does nothing
//! without a service manager.
void notify_supervisor_ready();

//! Notifies the service manager once a second that the program is alive, or systemd restarts it.
//! Call it once per frame.
void notify_supervisor_alive(double now_s);

//! Sets the status line of `systemctl status` if it has changed.
void notify_supervisor(std::string status);

//! Runs the rest of the program in a child process, and restarts it at once after a crash: a
//! service manager that also has to start the display takes several seconds. Returns only in the
//! child. This process exits with the child's status when the child exits normally, or fails within
//! its first seconds. Forwards signals that request its end. Call it before other threads start.
void restart_after_crashes();

}  // namespace ergodome
