#include "app/budget/play_budget.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/budget/budget_texts.h"
#include "render/accuracy/statistics.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Weight of the latest interval between pictures in the smoothed one, from which the displayed
//! frame rate is computed.
constexpr double smoothing = 0.1;
constexpr double errors_every_s = 1.0;
//! Number of pixel errors to keep: those of the last few measurements.
constexpr std::size_t remembered_errors = 1000;
//! Minimum number of errors for a 99 % quantile.
constexpr std::size_t telling_errors = 100;
//! Minimum number of errors before the lens is changed: in a smaller sample, the largest are mostly
//! chance.
constexpr std::size_t sure_errors = 500;
//! Each time the 99 % quantile of the errors exceeds the budget's error, the lens's budget is
//! multiplied by this.
constexpr double finer_step = 0.7;
//! Once the lens's budget is at most this share of the rung's, it is not reduced further.
constexpr double finest_share = 0.1;
//! If the 99 % quantile of the errors is below this share of the budget's error, one reduction of
//! the lens's budget is undone.
constexpr double far_within = 0.25;

std::vector<double> rung_times(const std::vector<Rung>& ladder) {
  std::vector<double> times_ms;
  times_ms.reserve(ladder.size());
  for (const Rung& rung : ladder) {
    times_ms.push_back(rung.frame_ms);
  }
  return times_ms;
}

//! Minimum width of pictures that are reduced to hold a rate.
constexpr int narrowest_px = 192;

//! Returns the only rung of a budget without a frame rate. It has the size of whole pictures; the
//! player may choose another size.
std::vector<Rung> single_rung(const SettingsMeasurement& measured, const Budget& budget) {
  // Leaves out direct rays that were measured as an alternative to an automatic lens: at other
  // sizes, `automatic` selects between grid and rays itself.
  std::vector<MeasuredSetting> lenses = measured.settings;
  std::erase_if(
      lenses, [&](const MeasuredSetting& each) { return each.quality.lens != measured.settings.front().quality.lens; });
  const MeasuredSetting& chosen = lenses[choose_setting(lenses, budget, BudgetFirst::error).setting];
  return {{chosen.quality, measured.width_px, chosen.error_px, chosen.moments, chosen.frame_ms()}};
}

}  // namespace

double lens_patience_ms(const Budget& budget) {
  constexpr double max_ms = 20.0;
  constexpr double share = 0.4;
  return budget.frame_rate_hz ? std::min(max_ms, share * budget.frame_ms()) : max_ms;
}

PlayBudget::PlayBudget(const PlayPlan& plan) : plan_(plan) {
  if (plan_.budget.frame_rate_hz) {
    keeper_.emplace(rung_times(plan_.ladder), plan_.budget.frame_ms(), plan_.first);
    record_.emplace(plan_.budget.frame_ms());
  }
}

void PlayBudget::note_picture(double work_ms, std::optional<double> interval_ms) {
  work_ms_ = work_ms;
  // Frames without motion do not count: they are refined as far as possible and may take any time.
  if (keeper_ && interval_ms) {
    keeper_->note(work_ms, *interval_ms);
    record_->note(*interval_ms);
    interval_ms_ = interval_ms_ > 0.0 ? interval_ms_ + smoothing * (*interval_ms - interval_ms_) : *interval_ms;
  }
}

Rung PlayBudget::rung() const {
  Rung rung = ladder_rung();
  rung.quality.budget_px *= lens_share_;
  return rung;
}

void PlayBudget::keep_to_error() {
  // Rungs whose measured error exceeds the budget exist only to hold the frame rate, so their
  // lenses are not made finer.
  const bool kept = plan_.budget.error_px && ladder_rung().error_px <= *plan_.budget.error_px;
  if (!kept || errors_px_.size() < sure_errors) {
    return;
  }
  const double share = error_px() / *plan_.budget.error_px;
  if (share > 1.0 && lens_share_ > finest_share) {
    lens_share_ *= finer_step;
  } else if (share < far_within && lens_share_ < 1.0) {
    lens_share_ = std::min(lens_share_ / finer_step, 1.0);
  } else {
    return;
  }
  // The errors measured so far belong to the old lens, so they are discarded.
  errors_px_.clear();
}

void PlayBudget::ask_errors(double now_s) { errors_due_s_ = now_s + errors_every_s; }

void PlayBudget::note_errors(const std::vector<double>& errors_px) {
  errors_px_.insert(errors_px_.end(), errors_px.begin(), errors_px.end());
  while (errors_px_.size() > remembered_errors) {
    errors_px_.pop_front();
  }
  keep_to_error();
}

double PlayBudget::error_px() const {
  return errors_px_.size() < telling_errors ? rung().error_px : summary_of({errors_px_.begin(), errors_px_.end()}).p99;
}

std::string PlayBudget::display_text() const {
  std::string text = fmt::format("budget {}: measured error {:.3f} px", text_of(plan_.budget), error_px());
  if (keeper_) {
    text += fmt::format(", {:.1f} of {:.1f} ms, {:.1f} fps, step {} of {}", work_ms_, plan_.budget.frame_ms(),
                        interval_ms_ > 0.0 ? 1000.0 / interval_ms_ : 0.0, keeper_->rung() + 1, plan_.ladder.size());
  }
  return text;
}

std::string PlayBudget::summary_text() const {
  const std::string error = fmt::format(
      "error {:.3g} px ({})", error_px(),
      errors_px_.size() < telling_errors ? "as measured at the start" : "99 % of the pixels of the last frames");
  if (!keeper_) {
    return fmt::format("budget {}: {}", text_of(plan_.budget), error);
  }
  return fmt::format(
      "{}; {}", record_text(plan_.budget, *record_, keeper_->changes(), keeper_->rung(), plan_.ladder.size()), error);
}

PlanWithText plan_play(ShowRenderer& renderer, const Show& show, const PlayChoice& choice) {
  MeasurementOrder order;
  order.budget = choice.budget;
  order.size_px = choice.size_px;
  order.lens = choice.lens;
  order.free_flight = choice.free_flight;
  const SettingsMeasurement measured = measure_settings(renderer, show, order);
  PlanWithText told;
  told.plan.budget = choice.budget;
  told.plan.whole_px = choice.size_px;
  told.plan.patience_ms = lens_patience_ms(choice.budget);
  if (choice.budget.frame_rate_hz) {
    LadderLimits limits;
    limits.widest_px = choice.size_px;
    limits.narrowest_px = choice.size_fixed ? choice.size_px : std::min(narrowest_px, choice.size_px);
    limits.height_to_width = measured.height_to_width;
    limits.patience_ms = told.plan.patience_ms;
    limits.grid_from_pixels = renderer.backend() == Backend::cpu ? min_grid_pixels : 0.0;
    told.plan.ladder = settings_ladder(measured.settings, choice.budget, limits);
    told.plan.first = first_rung(told.plan.ladder, choice.budget.frame_ms());
  } else {
    told.plan.ladder = single_rung(measured, choice.budget);
  }
  told.line = ladder_text(choice.budget, measured, told.plan.ladder, told.plan.first);
  return told;
}

}  // namespace ergodome
