#include "render/present/desktop.h"

#include <fmt/format.h>

#include <algorithm>

namespace ergodome {

bool overlap(const DesktopRectangle& a, const DesktopRectangle& b) {
  return std::max(a.x_px, b.x_px) < std::min(a.x_px + a.width_px, b.x_px + b.width_px) &&
         std::max(a.y_px, b.y_px) < std::min(a.y_px + a.height_px, b.y_px + b.height_px);
}

std::string monitor_list(const std::vector<DesktopMonitor>& monitors) {
  std::string list;
  for (std::size_t i = 0; i < monitors.size(); ++i) {
    const DesktopRectangle& screen = monitors[i].screen;
    list += fmt::format("{}{} ({}, {} x {} at {}, {})", i > 0 ? ", " : "", i, monitors[i].name, screen.width_px,
                        screen.height_px, screen.x_px, screen.y_px);
  }
  return list;
}

}  // namespace ergodome
