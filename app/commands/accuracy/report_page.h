#pragma once

#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! A plot that lies beside the page.
struct ReportPlot {
  std::string axis;
  std::string file;
  std::string caption;
};

//! The report as a page for people who know neither the program nor the subject. Pictures and plots lie beside it under the names that the
//! report and `plots` have. `most_px`: the error at which methods are compared.
std::string page_text(const AccuracyReport& report, const std::vector<ReportPlot>& plots, double most_px);

}  // namespace ergodome
