#pragma once

#include <string>

#include "app/budget/budget_choice.h"
#include "app/budget/lens_error.h"
#include "app/budget/rate_keeper.h"
#include "app/budget/settings_ladder.h"
#include "app/budget/settings_measurement.h"

namespace ergodome {

//! Describes settings: "lens of 0.35 px", "direct rays of 0.5 px, plain look at the map".
std::string text_of(const FrameQuality& quality);

//! Returns one line about the settings for the whole show: the choice, its error and time, where it
//! exceeds the budget, and how long the measurement took.
std::string choice_text(const Budget& budget, const SettingsMeasurement& measured, const BudgetChoice& choice);

//! Returns the line of choice_text() for a show that plays, at rung `first` of its ladder of
//! settings (settings_ladder.h).
std::string ladder_text(const Budget& budget, const SettingsMeasurement& measured, const std::vector<Rung>& ladder,
                        std::size_t first);

//! Returns the achieved frame rate of a show: "rate 29.9 of 30 fps held over 598 frames; ...".
std::string record_text(const Budget& budget, const RateRecord& record, long changes, std::size_t rung,
                        std::size_t rungs);

//! Returns one line about errors at random times of a show.
std::string check_text(const Budget& budget, const BudgetCheck& check);

}  // namespace ergodome
