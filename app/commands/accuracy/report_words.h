#pragma once

#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Returns the report's results as sentences: the cost of errors of one pixel, a quarter and a
//! tenth, and the comparison with published methods.
std::vector<std::string> accuracy_sentences(const AccuracyReport& report);

//! Returns the sentences of one axis.
std::vector<std::string> axis_sentences(const AccuracyAxis& axis);

//! Describes how well times repeated, and warns if methods cannot be ranked by this report.
std::string repeatability_words(const AccuracyReport& report);

//! Explains a method to readers who do not know it; empty if its name is enough.
std::string method_words(const std::string& method);

}  // namespace ergodome
