#include "render/present/projectors/projector_outputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

DesktopRectangle window_of(const ProjectorSetup& projector) {
  return {projector.output.window_x_px, projector.output.window_y_px, projector.width_px, projector.height_px};
}

void require_output(const ProjectorSetup& projector, const std::vector<DesktopMonitor>& monitors) {
  if (projector.output.monitor) {
    if (*projector.output.monitor >= static_cast<int>(monitors.size())) {
      throw Error(location_of(projector), fmt::format("there is no monitor {}", *projector.output.monitor),
                  monitors.empty() ? "connect it, or use window_px instead"
                                   : "choose from " + monitor_list(monitors) + ", or use window_px instead");
    }
    return;
  }
  const DesktopRectangle window = window_of(projector);
  const bool seen = monitors.empty() || std::ranges::any_of(monitors, [&](const DesktopMonitor& monitor) {
                      return overlap(window, monitor.screen);
                    });
  if (!seen) {
    throw Error(location_of(projector),
                fmt::format("no monitor shows its window, {} x {} pixels at window_px = [{}, {}]", window.width_px,
                            window.height_px, window.x_px, window.y_px),
                "move it to " + monitor_list(monitors) + ", or write monitor in place of window_px");
  }
}

}  // namespace

void require_outputs(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors) {
  for (const ProjectorSetup& projector : setup.projectors) {
    require_output(projector, monitors);
  }
}

std::vector<DesktopRectangle> output_rectangles(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors) {
  std::vector<DesktopRectangle> rectangles;
  rectangles.reserve(setup.projectors.size());
  for (const ProjectorSetup& projector : setup.projectors) {
    const auto monitor = static_cast<std::size_t>(projector.output.monitor.value_or(0));
    const bool fills_monitor = projector.output.monitor && monitor < monitors.size();
    rectangles.push_back(fills_monitor ? monitors[monitor].screen : window_of(projector));
  }
  return rectangles;
}

std::optional<DesktopRectangle> rectangle_beside_projectors(const DesktopRectangle& window, const DomeSetup& setup,
                                                            const std::vector<DesktopMonitor>& monitors) {
  const std::vector<DesktopRectangle> taken = output_rectangles(setup, monitors);
  if (std::ranges::none_of(taken, [&](const DesktopRectangle& other) { return overlap(window, other); })) {
    return std::nullopt;
  }
  return free_rectangle(window, monitors, taken);
}

}  // namespace ergodome
