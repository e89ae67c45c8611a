#pragma once

#include <string>

namespace ergodome {

//! Notifies the service manager (systemd, Type=notify) that the program is ready; does nothing without one.
void tell_supervisor_ready();

//! Notifies the service manager once a second that the program runs; call it once a frame. Otherwise systemd restarts the program.
void tell_supervisor_alive(double now_s);

//! Sets the status line of `systemctl status` if it has changed.
void tell_supervisor(std::string status);

}  // namespace ergodome
