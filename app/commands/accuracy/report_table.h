#pragma once

#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! The report as aligned text for a terminal. `most_px`: the error at which methods are compared.
std::string table_text(const AccuracyReport& report, double most_px);

//! Arcminutes that a displacement on the screen is worth; as text.
std::string arcmin_text(const AccuracyReport& report, double error_px);

}  // namespace ergodome
