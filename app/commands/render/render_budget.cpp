#include "app/commands/render/render_budget.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/budget/budget_texts.h"
#include "app/cli/backend_choice.h"
#include "app/cli/usage_error.h"
#include "calibration/projectors/projector_picture.h"
#include "content/files/console.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Seed of the random times at which --check measures.
constexpr std::uint64_t check_seed = 20;

const char* word_of(LensChoice choice) {
  switch (choice) {
    case LensChoice::streamed:
      return "streamed";
    case LensChoice::live:
      return "live";
    case LensChoice::direct:
      return "direct";
    case LensChoice::automatic:
      break;
  }
  return "auto";
}

void check_budget(ShowRenderer& renderer, const Show& show, const Budget& budget, const FrameQuality& quality,
                  const RenderOptions& options, int size_px) {
  const BudgetCheck check = check_error(renderer, show, quality, size_px, options.checked_moments, check_seed);
  print_out("{}\n", check_text(budget, check));
  if (check.worst_px > *budget.error_px) {
    throw Error(fmt::format("--budget {}", text_of(budget)),
                fmt::format("the error is {:.3g} px at {:.2f} s of {}", check.worst_px, check.worst_time_s, show.name),
                "choose a larger error budget, or try --lens direct");
  }
}

}  // namespace

bool use_render_budget(RenderOptions& options, Show& show, const std::optional<DomeSetup>& setup) {
  const Budget budget = parse_budget(options.budget);
  const bool checks = options.checked_moments > 0;
  if (checks && !budget.error_px) {
    throw UsageError("--check", "needs an error budget to check", "add one, for example --budget 0.25px");
  }
  if (budget.empty()) {
    return true;
  }
  const Backend backend = choose_backend(options.backend);
  // Uses a separate renderer, because automatic exposure would remember the frames measured here.
  ShowRenderer renderer(show, backend, lens_choice(options.lens), open_stream(show, options.lens, backend));
  MeasurementOrder order;
  order.budget = budget;
  order.size_px = options.size_px == 0 && setup ? enough_master_px(projector_pictures(*setup)) : options.size_px;
  order.lens = lens_choice(options.lens);
  const SettingsMeasurement measured = measure_settings(renderer, show, order);
  const BudgetChoice choice = choose_setting(measured.settings, budget, BudgetFirst::error);
  const FrameQuality quality = measured.settings[choice.setting].quality;
  print_out("{}\n", choice_text(budget, measured, choice));
  std::fflush(stdout);
  if (checks) {
    check_budget(renderer, show, budget, quality, options, order.size_px);
    return false;
  }
  show.quality.budget_px = quality.budget_px;
  show.sky.filter = quality.filter;
  options.lens.lens = word_of(quality.lens);
  return true;
}

}  // namespace ergodome
