#include "app/budget/play_plan.h"

#include "app/budget/budget_texts.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Minimum width of pictures that are reduced to hold a rate.
constexpr int narrowest_px = 192;

//! Returns a single rung for an error alone; the player chooses the size itself.
std::vector<Rung> single_rung(const SettingsMeasurement& measured, const Budget& budget) {
  // Both kinds of lens may be used, so choose a setting of the first one's kind.
  std::vector<MeasuredSetting> lenses = measured.settings;
  std::erase_if(
      lenses, [&](const MeasuredSetting& each) { return each.quality.lens != measured.settings.front().quality.lens; });
  const MeasuredSetting& chosen = lenses[choose_setting(lenses, budget, BudgetFirst::error).setting];
  return {{chosen.quality, measured.width_px, chosen.error_px, chosen.moments, chosen.frame_ms()}};
}

}  // namespace

ToldPlan plan_play(ShowRenderer& renderer, const Show& show, const PlayChoice& choice) {
  MeasurementOrder order;
  order.budget = choice.budget;
  order.size_px = choice.size_px;
  order.lens = choice.lens;
  order.free_flight = choice.free_flight;
  const SettingsMeasurement measured = measure_settings(renderer, show, order);
  ToldPlan told;
  told.plan.budget = choice.budget;
  told.plan.whole_px = choice.size_px;
  told.plan.patience_ms = lens_patience_ms(choice.budget);
  if (choice.budget.frame_rate_hz) {
    LadderLimits limits;
    limits.widest_px = choice.size_px;
    limits.narrowest_px = choice.size_fixed ? choice.size_px : std::min(narrowest_px, choice.size_px);
    limits.height_to_width = measured.height_to_width;
    limits.patience_ms = told.plan.patience_ms;
    limits.grid_from_pixels = renderer.backend() == Backend::cpu ? least_grid_pixels : 0.0;
    told.plan.ladder = settings_ladder(measured.settings, choice.budget, limits);
    told.plan.first = first_rung(told.plan.ladder, choice.budget.frame_ms());
  } else {
    told.plan.ladder = single_rung(measured, choice.budget);
  }
  told.line = ladder_text(choice.budget, measured, told.plan.ladder, told.plan.first);
  return told;
}

}  // namespace ergodome
