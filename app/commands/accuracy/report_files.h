#pragma once

#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! The report as a table, a line a choice: axis, method, setting, precision, published, errors (in the axis' unit; light as a part of 1),
//! times in ms. What was not measured is empty, and an error without bounds `inf`.
std::string csv_text(const AccuracyReport& report);

//! All of the report but the error pictures' pixels, with the time of each run. Errors without bounds are null.
std::string json_text(const AccuracyReport& report);

}  // namespace ergodome
