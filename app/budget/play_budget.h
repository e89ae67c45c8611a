#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/budget/budget.h"
#include "app/budget/rate_keeper.h"
#include "app/budget/rate_record.h"
#include "app/budget/settings_ladder.h"

namespace ergodome {

//! What a show that plays starts with: its budget, and the settings to choose from.
struct PlayPlan {
  Budget budget;
  std::vector<Rung> ladder;  //!< at least one
  std::size_t first = 0;
  int whole_px = 0;           //!< width that errors are counted in pixels of
  double patience_ms = 20.0;  //!< LadderLimits::patience_ms
};

//! How long a frame of a running show waits for its lens [ms]: as far as a rate leaves time for it.
double lens_patience_ms(const Budget& budget);

//! Keeps a running show to its budget, and knows what it costs. It has no clock of its own.
class PlayBudget {
 public:
  explicit PlayBudget(const PlayPlan& plan);

  //! The settings and size of the next picture. Where pictures were measured to be beyond the error, the lens is finer than the ladder's: a flight
  //! goes where nothing was measured before.
  [[nodiscard]] Rung rung() const;
  [[nodiscard]] const PlayPlan& plan() const { return plan_; }

  //! A picture took `work_ms` to draw, and came `interval_ms` after the one before, where something moved in both.
  void note_picture(double work_ms, std::optional<double> interval_ms);

  //! Whether the next picture is to be measured, too: now and then, so that it costs little.
  [[nodiscard]] bool wants_errors(double now_s) const { return now_s >= errors_due_s_; }
  void ask_errors(double now_s);
  //! Errors of some of a picture's pixels [px of the whole picture].
  void note_errors(const std::vector<double>& errors_px);
  //! What all but one in a hundred of the last measured pixels keep below [px]; as measured at the start until there are some.
  [[nodiscard]] double error_px() const;

  //! A line for the display: the budget, the error and, with a rate, the time of the last picture and the rung.
  [[nodiscard]] std::string display_text() const;
  //! A line for the end of the show.
  [[nodiscard]] std::string summary_text() const;

 private:
  [[nodiscard]] const Rung& ladder_rung() const { return plan_.ladder[keeper_ ? keeper_->rung() : plan_.first]; }
  void keep_to_error();

  PlayPlan plan_;
  std::optional<RateKeeper> keeper_;  //!< where there is a rate
  std::optional<RateRecord> record_;  //!< the same
  std::deque<double> errors_px_;
  double work_ms_ = 0.0;      //!< of the last picture
  double interval_ms_ = 0.0;  //!< of the last few, smoothed; 0: none yet
  double errors_due_s_ = 0.0;
  double lens_share_ = 1.0;  //!< of the rung's budget, for the lens
};

}  // namespace ergodome
