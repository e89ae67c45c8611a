#pragma once

#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! A plot file in the folder of the page.
struct ReportPlot {
  std::string axis;
  std::string file;
  std::string caption;
};

//! Returns the report as an HTML page for readers without prior knowledge. The files of pictures
//! and plots are in its folder, under the names given in the report and in `plots`. `max_px` is
//! the error at which methods are compared.
std::string page_text(const AccuracyReport& report, const std::vector<ReportPlot>& plots, double max_px);

}  // namespace ergodome
