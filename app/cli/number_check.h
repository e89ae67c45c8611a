#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "content/timeline/frame_rate.h"

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

//! For an option that takes a frame rate, as a number or as a fraction of two ("30000/1001"): makes it the number, exact where it is short for 1000/1001 of a
//! whole rate. For transform(), as check() changes no words.
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

//! For times of a show [s] that may lie anywhere.
inline CLI::Validator show_time() { return number_between(-1e12, 1e12); }

}  // namespace ergodome
