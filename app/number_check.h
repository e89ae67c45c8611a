#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace ergodome {

//! For an option that takes a number from `least` to `most`: CLI::Range lets "nan" through, and prints six digits of its ends.
inline CLI::Validator number_between(double least, double most) {
  return {[least, most](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return good ? std::string() : fmt::format("\"{}\" is not a number from {:g} to {:g}", text, least, most);
          },
          fmt::format("FLOAT in [{:g} - {:g}]", least, most)};
}

//! For times of a show [s] that may lie anywhere.
inline CLI::Validator show_time() { return number_between(-1e12, 1e12); }

}  // namespace ergodome
