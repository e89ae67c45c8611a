#pragma once

#include "app/budget/play_budget.h"
#include "app/budget/settings_measurement.h"

namespace ergodome {

//! What the operator chose for a show that plays.
struct PlayChoice {
  Budget budget;
  int size_px = 1024;       //!< width of one eye's whole picture
  bool size_fixed = false;  //!< never reduce the size to hold the rate
  LensChoice lens = LensChoice::automatic;
  bool free_flight = false;
};

//! A plan with the line that describes it.
struct ToldPlan {
  PlayPlan plan;
  std::string line;
};

//! Measures the show that the renderer was made for, and makes the ladder of settings to play it
//! with.
ToldPlan plan_play(ShowRenderer& renderer, const Show& show, const PlayChoice& choice);

}  // namespace ergodome
