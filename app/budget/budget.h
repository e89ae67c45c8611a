#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ergodome {

//! The cost that the operator allows for a show: an error on the screen, a frame rate, or both.
struct Budget {
  //! 99 % quantile of the displacement of directions on the screen [px of the whole picture].
  std::optional<double> error_px;
  //! Frame rate to hold; when rendering to files, the inverse of the time allowed per frame.
  std::optional<double> frame_rate_hz;

  bool operator==(const Budget&) const = default;

  [[nodiscard]] bool empty() const { return !error_px && !frame_rate_hz; }
  //! Returns the time per frame [ms]. Requires a frame rate.
  [[nodiscard]] double frame_ms() const { return 1000.0 / *frame_rate_hz; }
};

inline constexpr double min_budget_px = 0.01;
inline constexpr double max_budget_px = 16.0;
inline constexpr double min_budget_fps = 1.0;
inline constexpr double max_budget_fps = 1000.0;

//! Parses a budget from words of the command line: "0.25px", "60fps", "0.25px,60fps" or "0.25px
//! 60fps", in any number of words; no words give an empty budget. Each number needs a unit. Throws
//! UsageError for words that are all blank, for malformed or out-of-range numbers, and for a second
//! one with the same unit.
Budget parse_budget(const std::vector<std::string>& words);

//! Formats a budget as parse_budget() reads it: "0.25px,60fps".
std::string text_of(const Budget& budget);

}  // namespace ergodome
