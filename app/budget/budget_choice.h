#pragma once

#include <cstddef>
#include <span>

#include "app/budget/budget.h"
#include "app/budget/measured_setting.h"

namespace ergodome {

//! Which half of a budget is kept where both cannot be: files can wait for accuracy, and a show on a screen cannot.
enum class BudgetFirst { error, rate };

//! The setting that was chosen, by its number, and whether it keeps to each half of the budget; what the budget does not ask for is kept.
struct BudgetChoice {
  std::size_t setting = 0;
  bool holds_error = true;
  bool holds_rate = true;
};

//! Chooses from measured settings, of which there is at least one.
//!
//! An error alone: the cheapest setting within it. A rate alone: the most accurate one whose frames are in time. Both: the cheapest that keeps to
//! both; where there is none, what keeps to the half that comes first: the cheapest within the error, or the most accurate in time. Where not
//! even one half can be kept, the nearest to it: the most accurate, or the cheapest. Times within a twentieth of each other are alike, and then
//! the smaller error decides; so it is the other way round. Another filter of the map than the first setting's, which no error on the screen
//! tells of, is taken only where the rate asks for it. What was not measured is taken as beyond everything.
BudgetChoice choose_setting(std::span<const MeasuredSetting> settings, const Budget& budget, BudgetFirst first);

}  // namespace ergodome
