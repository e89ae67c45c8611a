#pragma once

#include <cstddef>
#include <span>

#include "app/budget/budget.h"
#include "app/budget/measured_setting.h"

namespace ergodome {

//! Which half of a budget has priority if both cannot be met: the error for files, the rate for a
//! show on the screen.
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
//! in time. For both: the cheapest that meets both; if there is none, the cheapest within the error
//! or the most accurate in time, whichever half comes first. If not even that half can be met: the
//! setting nearest to it. Times within 5 % count as equal, and then the smaller error decides; and
//! vice versa. The filter of the map differs from the first setting's only if the rate requires it,
//! because errors do not include it. Values that were not measured count as infinite.
BudgetChoice choose_setting(std::span<const MeasuredSetting> settings, const Budget& budget, BudgetFirst first);

}  // namespace ergodome
