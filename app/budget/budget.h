#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ergodome {

//! What a person lets a show cost: an error on the screen, a rate of frames, or both.
struct Budget {
  //! What directions may be wrong by on the screen, for all but one in a hundred [px of the whole picture].
  std::optional<double> error_px;
  //! Frames a second that are to be held; where frames are written to files, one over the time that each may take.
  std::optional<double> frame_rate_hz;

  bool operator==(const Budget&) const = default;

  [[nodiscard]] bool empty() const { return !error_px && !frame_rate_hz; }
  //! Time of a frame [ms]. The budget has a rate.
  [[nodiscard]] double frame_ms() const { return 1000.0 / *frame_rate_hz; }
};

inline constexpr double least_budget_px = 0.01;
inline constexpr double most_budget_px = 16.0;
inline constexpr double least_budget_fps = 1.0;
inline constexpr double most_budget_fps = 1000.0;

//! The budget that words of the command line tell: "0.25px", "60fps", "0.25px,60fps" or "0.25px 60fps", in as many words as there are. A
//! number alone has no meaning: it could be either. Throws Error for what is neither, out of bounds or told twice.
Budget parse_budget(const std::vector<std::string>& words);

//! The same as parse_budget() reads: "0.25px,60fps".
std::string text_of(const Budget& budget);

}  // namespace ergodome
