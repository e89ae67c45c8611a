#pragma once

#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! The choices of one method in one precision: a line of a plot, and an entry of its numbered
//! legend.
struct ReportSeries {
  int number = 0;  //!< from 1; the same in plot, legend and table
  std::string name;
  std::string colour;  //!< "#009e73"
  bool published = false;
  std::vector<const Measurement*> choices;
};

//! The series of an axis in the order of its choices. They point into the axis.
std::vector<ReportSeries> series_of(const AccuracyAxis& axis);

}  // namespace ergodome
