#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "content/timeline/frame_rate.h"

namespace ergodome {

//! Returns a check for an option with a number from `least` to `most`. Unlike CLI::Range, it
//! rejects "nan" and prints the limits in full.
inline CLI::Validator number_between(double least, double most) {
  return {[least, most](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return good ? std::string() : fmt::format("\"{}\" is not a number from {:g} to {:g}", text, least, most);
          },
          fmt::format("FLOAT in [{:g} - {:g}]", least, most)};
}

//! Returns a check for an option with a frame rate, as a number or as a fraction ("30000/1001").
//! Converts it to a number, which is exact if it is an abbreviation of 1000/1001 of an integer
//! rate. For transform(), because check() cannot change the value.
inline CLI::Validator frame_rate_between(double least, double most) {
  return {[least, most](std::string& text) {
            const std::size_t slash = text.find('/');
            double frames = 0.0;
            double seconds = 1.0;
            const bool good =
                CLI::detail::lexical_cast(text.substr(0, slash), frames) &&
                (slash == std::string::npos || CLI::detail::lexical_cast(text.substr(slash + 1), seconds)) &&
                frames / seconds >= least && frames / seconds <= most;
            if (!good) {
              return fmt::format("\"{}\" is not a number from {:g} to {:g}, nor a fraction like 30000/1001", text,
                                 least, most);
            }
            text = fmt::format("{:.17g}", exact_rate_hz(frames / seconds));
            return std::string();
          },
          fmt::format("FLOAT in [{:g} - {:g}]", least, most)};
}

//! Returns a check for show times [s] without limits.
inline CLI::Validator show_time() { return number_between(-1e12, 1e12); }

}  // namespace ergodome
