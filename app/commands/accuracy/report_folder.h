#pragma once

#include <filesystem>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Writes report.html with all files that it shows, accuracy.csv and accuracy.json into an existing
//! folder. Without gnuplot, the page has no plots and the report notes it. Throws Error if a file
//! cannot be written.
void write_report_folder(AccuracyReport& report, double most_px, const std::filesystem::path& folder);

}  // namespace ergodome
