#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "app/budget/budget.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! Settings of a picture with their measured error and time; NaN if not measured.
struct MeasuredSetting {
  FrameQuality quality;  //!< with an error budget in pixels of the whole picture
  //! 99 % quantile of the displacement of directions, at the worst of the measured times [px of the
  //! whole picture].
  double error_px = std::numeric_limits<double>::quiet_NaN();
  //! Time to build the lenses of a frame for a new camera position; 0 if neither the camera's r and
  //! θ nor the spacetime change.
  double lens_ms = std::numeric_limits<double>::quiet_NaN();
  //! Time of a picture whose lens exists: the part that does not depend on its size, and the part
  //! proportional to its number of pixels, at the size of the whole picture.
  double fixed_ms = std::numeric_limits<double>::quiet_NaN();
  double pixels_ms = std::numeric_limits<double>::quiet_NaN();
  //! Number of show times at which the error was measured; fewer than all if the error was too
  //! large at one, or if time ran out.
  int moments = 0;

  //! Returns the time of a picture whose lens exists [ms]. `pixel_share`: its number of pixels
  //! relative to the whole picture.
  [[nodiscard]] double picture_ms(double pixel_share = 1.0) const { return fixed_ms + pixel_share * pixels_ms; }
  //! Returns the time of a whole frame with its lens [ms].
  [[nodiscard]] double frame_ms() const { return lens_ms + picture_ms(); }
};

//! Safety factor: a setting is within a budget if its measured error is at most this share of it,
//! because other pixels and show times may be worse. Close to a spinning hole they were up to 1.8
//! times worse.
inline constexpr double kept_share = 0.5;

//! Returns whether an error is within a budget, including the safety factor.
inline bool is_within(double error_px, double budget_px) { return error_px <= kept_share * budget_px; }

//! Which half of a budget (its error or its frame rate) has priority if both cannot be met. When
//! rendering to files, the error has priority; for a show on the screen, the rate.
enum class BudgetFirst { error, rate };

//! The index of the chosen setting, and whether it meets each half of the budget. A half that is
//! not requested counts as met.
struct BudgetChoice {
  std::size_t setting = 0;
  bool holds_error = true;
  bool holds_rate = true;
};

//! Chooses from measured settings; there must be at least one.
//!
//! For an error alone: the cheapest setting within it. For a rate alone: the most accurate setting
//! that is fast enough. For both: the cheapest that meets both; if none does, `first` chooses
//! between the cheapest within the error and the most accurate that is fast enough. If not even
//! that half can be met: the most accurate setting if it is the error, the cheapest if it is the
//! rate. "Cheapest" means the shortest frame time. Where times are compared, those within 5 % count
//! as equal, and the smaller error decides; where errors are compared, those within 5 % count as
//! equal, and the shorter time decides. The filter of the sky map differs from the first setting's
//! only if the rate requires it, because the measured errors do not include the filter. Values that
//! were not measured count as infinite.
BudgetChoice choose_setting(std::span<const MeasuredSetting> settings, const Budget& budget, BudgetFirst first);

}  // namespace ergodome
