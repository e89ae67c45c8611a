#pragma once

#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Returns the report as aligned text for a terminal. `max_px` is the error at which methods are
//! compared.
std::string table_text(const AccuracyReport& report, double max_px);

//! Converts a displacement in pixels to arcminutes, as text.
std::string arcmin_text(const AccuracyReport& report, double error_px);

}  // namespace ergodome
