#pragma once

#include <optional>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "render/present/desktop.h"

// Places projectors' outputs on the desktop.

namespace ergodome {

//! Throws Error, listing the connected monitors, if a setup names a missing monitor or a window
//! outside all monitors.
void require_outputs(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors);

//! Returns the desktop rectangles of a setup's projectors: the monitor, or the window if no monitor
//! is set or it is not connected.
std::vector<DesktopRectangle> output_rectangles(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors);

//! Returns a position for a window that projectors would cover at its current position. Returns
//! nothing if none covers it, or if there is no room elsewhere.
std::optional<DesktopRectangle> rectangle_beside_projectors(const DesktopRectangle& window, const DomeSetup& setup,
                                                            const std::vector<DesktopMonitor>& monitors);

}  // namespace ergodome
