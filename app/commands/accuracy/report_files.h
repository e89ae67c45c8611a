#pragma once

#include <filesystem>
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

//! Writes report.html with all files that it shows, accuracy.csv and accuracy.json into an existing
//! folder. Without gnuplot, the page has no plots and the report notes it. Throws Error if a file
//! cannot be written.
void write_report_folder(AccuracyReport& report, double max_px, const std::filesystem::path& folder);

}  // namespace ergodome
