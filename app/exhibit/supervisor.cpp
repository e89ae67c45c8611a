#include "app/exhibit/supervisor.h"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cmath>

namespace ergodome {

void tell_supervisor_ready() { sd_notify(0, "READY=1"); }

void tell_supervisor_alive(double now_s) {
  static double said_s = -1.0;
  if (said_s < 0.0 || std::abs(now_s - said_s) >= 1.0) {
    said_s = now_s;
    sd_notify(0, "WATCHDOG=1");
  }
}

void tell_supervisor(std::string status) {
  static std::string said;
  // A newline would start another message.
  std::ranges::replace(status, '\n', ' ');
  if (status != said) {
    said = status;
    sd_notify(0, ("STATUS=" + status).c_str());
  }
}

}  // namespace ergodome
