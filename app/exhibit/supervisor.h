#pragma once

#include <string>

namespace ergodome {

//! Tells the service manager that started the program (systemd, Type=notify) that it is ready to be seen; without one does nothing.
void tell_supervisor_ready();

//! Tells it that the program is alive; called once a frame, it speaks up once a second. A program that falls silent is started again.
void tell_supervisor_alive(double now_s);

//! A line for `systemctl status`, told when it is another one than the last.
void tell_supervisor(std::string status);

}  // namespace ergodome
