#pragma once

#include <filesystem>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Writes report.html with all that it shows, accuracy.csv and accuracy.json into a folder that is there. Without gnuplot the page has no
//! plots, and the report says so. Throws Error for what cannot be written.
void write_report_folder(AccuracyReport& report, double most_px, const std::filesystem::path& folder);

}  // namespace ergodome
