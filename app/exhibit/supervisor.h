#pragma once

#include <string>

namespace ergodome {

//! Notifies the service manager (systemd, Type=notify) that the program is ready. Does nothing
//! without a service manager.
void tell_supervisor_ready();

//! Notifies the service manager once a second that the program is alive, or systemd restarts it.
//! Call it once per frame.
void tell_supervisor_alive(double now_s);

//! Sets the status line of `systemctl status` if it has changed.
void tell_supervisor(std::string status);

}  // namespace ergodome
