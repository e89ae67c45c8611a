#pragma once

#include <string>

#include "app/budget/budget_choice.h"
#include "app/budget/lens_error.h"
#include "app/budget/rate_keeper.h"
#include "app/budget/settings_ladder.h"
#include "app/budget/settings_measurement.h"

namespace ergodome {

//! Describes settings: "lens at 0.35 px", "direct rays at 0.5 px, point sampling of the sky map".
std::string text_of(const FrameQuality& quality);

//! Returns one line about the settings for the whole show: the choice, its error and time, where it
//! exceeds the budget, and how long the measurement took.
std::string choice_text(const Budget& budget, const SettingsMeasurement& measured, const BudgetChoice& choice);

//! Returns the line of choice_text() for a show that plays, at rung `first` of its ladder of
//! settings (settings_ladder.h).
std::string ladder_text(const Budget& budget, const SettingsMeasurement& measured, const std::vector<Rung>& ladder,
                        std::size_t first);

//! Describes the achieved frame rate of a show: "budget 30fps: 29.90 fps over 598 frames (...". The
//! budget must have a rate. `changes`: how often the rung changed; `rung`: the last one's index in
//! a ladder of `rungs`.
std::string record_text(const Budget& budget, const RateRecord& record, long changes, std::size_t rung,
                        std::size_t rungs);

//! Returns one line about errors at random times of a show. The budget must have an error.
std::string check_text(const Budget& budget, const BudgetCheck& check);

}  // namespace ergodome
