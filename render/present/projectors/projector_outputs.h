#pragma once

#include <optional>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "render/present/desktop.h"

namespace ergodome {

//! Throws Error, with the monitors that there are, where a setup names one that is not, or a window that lies beside them all.
void require_outputs(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors);

//! Where a setup's projectors are shown on the desktop. Their monitors must be there.
std::vector<DesktopRectangle> output_rectangles(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors);

//! A place for a window that projectors cover. None where they do not, or where there is no room beside them.
std::optional<DesktopRectangle> place_beside_projectors(const DesktopRectangle& window, const DomeSetup& setup,
                                                        const std::vector<DesktopMonitor>& monitors);

}  // namespace ergodome
