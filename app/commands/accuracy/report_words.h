#pragma once

#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! Formats a number with two significant digits below 10, and as an integer above; from 100,000 on
//! as "1.2e+06". Returns "-" if it is not finite.
std::string short_number(double value);

//! Formats an error with the unit of its axis: "0.25 px", or "1.3 %" for 0.013 of the light.
std::string error_text(const AccuracyAxis& axis, double error);

//! Formats an error in the unit of its axis, without the unit.
std::string error_number(const AccuracyAxis& axis, double error);

//! Formats a median with its range: "7.0 (6.8 to 7.4)".
std::string spread_text(const Spread& spread);

//! Formats a size in kB, or from a million bytes on in MB: "20 kB", "1.5 MB".
std::string bytes_text(std::size_t bytes);

//! Names a choice: "conforming grid, budget 0.25 px".
std::string choice_name(const Measurement& choice);

//! Returns the sentences of all axes (axis_sentences()); the first of each axis begins with its
//! title.
std::vector<std::string> accuracy_sentences(const AccuracyReport& report);

//! Returns the results of one axis as sentences. Few choices: one sentence for each. Otherwise:
//! what errors of one pixel, a quarter, a tenth and a hundredth cost in time, and the comparison
//! with published methods.
std::vector<std::string> axis_sentences(const AccuracyAxis& axis);

//! Describes how well times repeated, and warns if methods cannot be ranked by this report.
std::string repeatability_words(const AccuracyReport& report);

//! Explains a method to readers who do not know it; empty if its name is enough.
std::string method_words(const std::string& method);

}  // namespace ergodome
