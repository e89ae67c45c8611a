#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/budget/budget.h"
#include "app/budget/rate_keeper.h"
#include "app/budget/settings_ladder.h"
#include "app/budget/settings_measurement.h"

namespace ergodome {

//! Input of PlayBudget: the budget of a show, and the settings to choose from while it plays.
struct PlayPlan {
  Budget budget;
  std::vector<Rung> ladder;  //!< at least one rung
  //! Index of the rung to start with.
  std::size_t first = 0;
  int whole_px = 0;           //!< width of a whole picture; errors are in its pixels
  double patience_ms = 20.0;  //!< LadderLimits::patience_ms
};

//! Returns how long a frame of a running show may wait for its lens before it uses an older one
//! [ms]: 40 % of the frame time of the budget's rate, but at most 20 ms; 20 ms without a rate.
double lens_patience_ms(const Budget& budget);

//! Keeps a running show within its budget and records its cost. Reads no clock: callers pass the
//! times.
class PlayBudget {
 public:
  explicit PlayBudget(const PlayPlan& plan);

  //! Returns the settings and size of the next picture. If measured errors exceed the budget, the
  //! lens is finer than the ladder's: a flight reaches positions that were not measured before.
  [[nodiscard]] Rung rung() const;
  [[nodiscard]] const PlayPlan& plan() const { return plan_; }

  //! Records that a picture took `work_ms` to draw. `interval_ms`: time since the one before; only
  //! given if something moved in both, and otherwise neither time counts for the rate.
  void note_picture(double work_ms, std::optional<double> interval_ms);

  //! Returns whether errors of the next picture should be measured: a second has passed since
  //! ask_errors(), which records that a measurement was requested.
  [[nodiscard]] bool wants_errors(double now_s) const { return now_s >= errors_due_s_; }
  void ask_errors(double now_s);
  //! Adds errors of some pixels of a picture [px of the whole picture], and makes the lens of
  //! rung() finer or coarser if the errors require or allow it.
  void note_errors(const std::vector<double>& errors_px);
  //! Returns the 99 % quantile of the last measured errors [px]; with fewer than 100 of them, the
  //! rung's error measured at the start.
  [[nodiscard]] double error_px() const;

  //! Returns a line for the screen: the budget and the error; if the budget has a rate, also the
  //! time of the last picture, the smoothed frame rate and the rung.
  [[nodiscard]] std::string display_text() const;
  //! Returns a line for the end of the show: error_px() and, if the budget has a rate, the achieved
  //! rate.
  [[nodiscard]] std::string summary_text() const;

 private:
  [[nodiscard]] const Rung& ladder_rung() const { return plan_.ladder[keeper_ ? keeper_->rung() : plan_.first]; }
  void keep_to_error();

  PlayPlan plan_;
  std::optional<RateKeeper> keeper_;  //!< empty if the budget has no frame rate
  std::optional<RateRecord> record_;  //!< empty if the budget has no frame rate
  std::deque<double> errors_px_;
  double work_ms_ = 0.0;      //!< drawing time of the last picture
  double interval_ms_ = 0.0;  //!< smoothed interval between pictures; 0: none yet
  double errors_due_s_ = 0.0;
  double lens_share_ = 1.0;  //!< factor on the rung's lens budget
};

//! The operator's choices for a running show.
struct PlayChoice {
  Budget budget;
  int size_px = 1024;       //!< width of one eye's whole picture
  bool size_fixed = false;  //!< never reduce the size to hold the rate
  LensChoice lens = LensChoice::automatic;
  bool free_flight = false;
};

//! A plan with the line that describes it.
struct PlanWithText {
  PlayPlan plan;
  std::string line;
};

//! Measures the show that the renderer was made for, and makes the ladder of settings to play it
//! with: one rung if the budget has no frame rate.
PlanWithText plan_play(ShowRenderer& renderer, const Show& show, const PlayChoice& choice);

}  // namespace ergodome
