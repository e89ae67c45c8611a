#pragma once

#include <filesystem>
#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Returns the report as CSV, a header and one line per choice: among others show, axis, method,
//! setting, errors (in the unit of the axis; light as a fraction) and times [ms]. Flicker, light
//! error and disk size are empty if they were not measured; an unbounded error is `inf`.
std::string csv_text(const AccuracyReport& report);

//! Returns the whole report as JSON, with the time of each run, but without the pixels of the error
//! pictures. An unbounded error is null.
std::string json_text(const AccuracyReport& report);

//! Writes report.html with all files that it shows, accuracy.csv and accuracy.json into an existing
//! folder. `max_px`: the error at which methods are compared. Without gnuplot, the page has no
//! plots and a note is added to the report. Throws Error if a file cannot be written.
void write_report_folder(AccuracyReport& report, double max_px, const std::filesystem::path& folder);

}  // namespace ergodome
