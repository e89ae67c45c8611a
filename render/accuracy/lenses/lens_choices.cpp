#include <initializer_list>

#include "render/accuracy/lenses/lens_race.h"

namespace ergodome {

namespace {

constexpr double tolerances_px[] = {0.05, 0.005};
constexpr double budgets_px[] = {1.0, 0.25, 0.1, 0.05, 0.025};

//! Returns the finest levels of the published grid. Its authors go to 10, which is too coarse for a
//! tenth of a pixel in a large picture.
std::vector<int> levels(bool quick) {
  return quick ? std::vector<int>{8, 9, 10, 11} : std::vector<int>{9, 10, 11, 12, 13};
}

void add_own(std::vector<LensChoiceToMeasure>& choices) {
  for (const double tolerance_px : tolerances_px) {
    choices.push_back(direct_choice(tolerance_px));
  }
  for (const double budget_px : budgets_px) {
    choices.push_back(grid_choice(budget_px));
  }
}

void add_rays(std::vector<LensChoiceToMeasure>& choices, TraceMethod method, bool narrow,
              std::initializer_list<double> tolerances) {
  for (const double tolerance : tolerances) {
    choices.push_back(ray_choice(method, narrow, tolerance));
  }
}

}  // namespace

std::vector<LensChoiceToMeasure> sky_choices(bool quick) {
  std::vector<LensChoiceToMeasure> choices;
  add_own(choices);
  for (const int level : levels(quick)) {
    choices.push_back(quadtree_choice(level, false));
    choices.push_back(quadtree_choice(level, true));
  }
  add_rays(choices, TraceMethod::taylor, true, {1e-3, 1e-4, 1e-5, 1e-6});
  add_rays(choices, TraceMethod::taylor, false, {1e-5, 1e-7, 1e-10});
  add_rays(choices, TraceMethod::cash_karp, true, {1e-1, 1e-2, 1e-3, 1e-5});
  add_rays(choices, TraceMethod::cash_karp, false, {1e-3, 1e-5, 1e-7});
  add_rays(choices, TraceMethod::rk34, true, {1e-2, 1e-3, 1e-4, 1e-5});
  add_rays(choices, TraceMethod::rk34, false, {1e-3, 1e-5});
  add_rays(choices, TraceMethod::baseline_rk34, true, {1e-2, 1e-3, 1e-4});
  add_rays(choices, TraceMethod::baseline_rk34, false, {1e-3, 1e-4});
  if (!quick) {
    add_rays(choices, TraceMethod::cash_karp, false, {1e-9});
    add_rays(choices, TraceMethod::rk34, false, {1e-7});
    add_rays(choices, TraceMethod::baseline_rk34, true, {1e-5});
    add_rays(choices, TraceMethod::baseline_rk34, false, {1e-5});
  }
  choices.push_back(ray_choice(TraceMethod::closed_form, false, 0.0));
  return choices;
}

std::vector<LensChoiceToMeasure> footprint_choices(bool quick) {
  std::vector<LensChoiceToMeasure> choices;
  add_own(choices);
  for (const int level : levels(quick)) {
    choices.push_back(quadtree_pixel_choice(level));
  }
  return choices;
}

}  // namespace ergodome
