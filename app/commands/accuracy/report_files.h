#pragma once

#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Returns the report as CSV, one line per choice: axis, method, setting, precision, published,
//! errors (in the unit of the axis; light as a fraction), times in ms. A value that was not
//! measured is empty; an unbounded error is `inf`.
std::string csv_text(const AccuracyReport& report);

//! Returns the whole report as JSON, with the time of each run, but without the pixels of the error
//! pictures. An unbounded error is null.
std::string json_text(const AccuracyReport& report);

}  // namespace ergodome
