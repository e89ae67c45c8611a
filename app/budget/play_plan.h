#pragma once

#include "app/budget/play_budget.h"
#include "app/budget/settings_measurement.h"

namespace ergodome {

//! What a person chose of a show that is to play.
struct PlayChoice {
  Budget budget;
  int size_px = 1024;       //!< width of one eye's whole picture
  bool size_fixed = false;  //!< no smaller pictures for the rate's sake
  LensChoice lens = LensChoice::automatic;
  bool free_flight = false;
};

//! A plan, and the line that says so.
struct ToldPlan {
  PlayPlan plan;
  std::string line;
};

//! Measures a show, which the renderer was made for, and makes the ladder of settings that it will play with.
ToldPlan plan_play(ShowRenderer& renderer, const Show& show, const PlayChoice& choice);

}  // namespace ergodome
