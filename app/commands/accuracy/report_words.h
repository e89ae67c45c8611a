#pragma once

#include <string>
#include <vector>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! What a report says, in sentences that need no table: what errors of a pixel, a quarter and a tenth cost, and what the published methods do.
std::vector<std::string> accuracy_sentences(const AccuracyReport& report);

//! The sentences of one axis alone.
std::vector<std::string> axis_sentences(const AccuracyAxis& axis);

//! How well times repeated, and if they did not, that methods cannot be ranked by this report.
std::string repeatability_words(const AccuracyReport& report);

//! What a method is, for people who have not met it; empty for one that needs no word.
std::string method_words(const std::string& method);

}  // namespace ergodome
