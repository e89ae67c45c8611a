#pragma once

#include <vector>

#include "calibration/dome_setup.h"
#include "render/present/desktop.h"

namespace ergodome {

//! Throws Error, with the monitors that there are, where a setup names one that is not, or a window that lies beside them all.
void require_outputs(const DomeSetup& setup, const std::vector<DesktopMonitor>& monitors);

}  // namespace ergodome
