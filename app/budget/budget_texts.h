#pragma once

#include <string>

#include "app/budget/budget_check.h"
#include "app/budget/budget_choice.h"
#include "app/budget/rate_record.h"
#include "app/budget/settings_ladder.h"
#include "app/budget/settings_measurement.h"

namespace ergodome {

//! "lens of 0.35 px", "direct rays of 0.5 px, plain look at the map".
std::string text_of(const FrameQuality& quality);

//! A line about settings that serve all of a show: what was chosen, what it misses by and takes, what of the budget it misses, and how long the
//! measuring took.
std::string choice_text(const Budget& budget, const SettingsMeasurement& measured, const BudgetChoice& choice);

//! The same for a show that plays, at a rung of its ladder.
std::string ladder_text(const Budget& budget, const SettingsMeasurement& measured, const std::vector<Rung>& ladder,
                        std::size_t first);

//! What a rate became over a show: "rate 29.9 of 30 fps held over 598 frames; ...".
std::string record_text(const Budget& budget, const RateRecord& record, long changes, std::size_t rung,
                        std::size_t rungs);

//! A line about errors at random moments of a show.
std::string check_text(const Budget& budget, const BudgetCheck& check);

}  // namespace ergodome
