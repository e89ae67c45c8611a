#pragma once

#include <string>

#include "render/accuracy/measurement.h"

namespace ergodome {

//! A number with as many digits as a person reads: three, "0.0012", "35", "1.2e+06"; "-" for what is not finite.
std::string short_number(double value);

//! An error in the unit of its axis: "0.25 px", "1.3 %".
std::string error_text(const AccuracyAxis& axis, double error);

//! The number alone, in that unit.
std::string error_number(const AccuracyAxis& axis, double error);

//! "7.0 (6.8 to 7.4)".
std::string spread_text(const Spread& spread);

//! "20 kB".
std::string bytes_text(std::size_t bytes);

//! "conforming grid, budget 0.25 px".
std::string choice_name(const Measurement& choice);

}  // namespace ergodome
