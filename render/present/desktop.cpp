#include "render/present/desktop.h"

#include <fmt/format.h>

#include <algorithm>

namespace ergodome {

namespace {

bool lies_within(const DesktopRectangle& inner, const DesktopRectangle& outer) {
  return inner.x_px >= outer.x_px && inner.y_px >= outer.y_px &&
         inner.x_px + inner.width_px <= outer.x_px + outer.width_px &&
         inner.y_px + inner.height_px <= outer.y_px + outer.height_px;
}

}  // namespace

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

std::optional<DesktopRectangle> free_rectangle(const DesktopRectangle& window,
                                               const std::vector<DesktopMonitor>& monitors,
                                               std::span<const DesktopRectangle> taken) {
  for (const DesktopMonitor& monitor : monitors) {
    // If a window fits somewhere, it also fits after being pushed up and left against an edge of
    // the monitor or of a taken rectangle.
    std::vector<int> lefts = {monitor.work_area.x_px};
    std::vector<int> tops = {monitor.work_area.y_px};
    for (const DesktopRectangle& other : taken) {
      lefts.push_back(other.x_px + other.width_px);
      tops.push_back(other.y_px + other.height_px);
    }
    std::ranges::sort(lefts);
    std::ranges::sort(tops);
    for (const int top : tops) {
      for (const int left : lefts) {
        const DesktopRectangle position = {left, top, window.width_px, window.height_px};
        if (lies_within(position, monitor.work_area) &&
            std::ranges::none_of(taken, [&](const DesktopRectangle& other) { return overlap(position, other); })) {
          return position;
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace ergodome
