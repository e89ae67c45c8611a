#include "app/budget/budget_choice.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace ergodome {

namespace {

//! Times and errors within this ratio count as equal.
constexpr double alike = 1.05;

double known_or_infinite(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

using SettingFilter = std::function<bool(const MeasuredSetting&)>;
using SettingNumber = std::function<double(const MeasuredSetting&)>;

double time_of_setting(const MeasuredSetting& setting) { return known_or_infinite(setting.frame_ms()); }
double error_of_setting(const MeasuredSetting& setting) { return known_or_infinite(setting.error_px); }

//! Returns the index of the setting with the least `cost` among those that satisfy `may`; nothing
//! if none does. Among costs within the factor `alike` of the least, the least `other` decides.
std::optional<std::size_t> cheapest_setting(std::span<const MeasuredSetting> settings, const SettingFilter& may,
                                            const SettingNumber& cost, const SettingNumber& other) {
  double minimum = std::numeric_limits<double>::infinity();
  for (const MeasuredSetting& setting : settings) {
    minimum = may(setting) ? std::min(minimum, cost(setting)) : minimum;
  }
  std::optional<std::size_t> best;
  // If no cost is known, the first setting that satisfies `may` is chosen, in the order of
  // measurement.
  const bool known = std::isfinite(minimum);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (may(settings[i]) && cost(settings[i]) <= alike * minimum &&
        (!best || (known && other(settings[i]) < other(settings[*best])))) {
      best = i;
    }
  }
  return best;
}

//! Implements choose_setting() for the settings that satisfy `may`.
BudgetChoice choose_of(std::span<const MeasuredSetting> settings, const Budget& budget, BudgetFirst first,
                       const SettingFilter& may) {
  const auto in_error = [&](const MeasuredSetting& setting) {
    return !budget.error_px || is_within(error_of_setting(setting), *budget.error_px);
  };
  const auto in_time = [&](const MeasuredSetting& setting) {
    return !budget.frame_rate_hz || time_of_setting(setting) <= budget.frame_ms();
  };
  const auto any = [](const MeasuredSetting&) { return true; };
  const auto of_those = [&](const auto& more) {
    return [&](const MeasuredSetting& setting) { return may(setting) && more(setting); };
  };
  const auto cheapest = [&](const auto& more) {
    return cheapest_setting(settings, of_those(more), time_of_setting, error_of_setting);
  };
  const auto most_accurate = [&](const auto& more) {
    return cheapest_setting(settings, of_those(more), error_of_setting, time_of_setting);
  };
  const auto both = [&](const MeasuredSetting& setting) { return in_error(setting) && in_time(setting); };
  std::optional<std::size_t> best = budget.error_px ? cheapest(both) : most_accurate(both);
  const bool error_first = budget.error_px && (first == BudgetFirst::error || !budget.frame_rate_hz);
  if (!best) {
    best = error_first ? cheapest(in_error) : most_accurate(in_time);
  }
  if (!best) {
    best = error_first ? most_accurate(any) : cheapest(any);
  }
  const MeasuredSetting& chosen = settings[best.value_or(0)];
  return {best.value_or(0), in_error(chosen), in_time(chosen)};
}

}  // namespace

BudgetChoice choose_setting(std::span<const MeasuredSetting> settings, const Budget& budget, BudgetFirst first) {
  const SkyFilter filter = settings.front().quality.filter;
  const BudgetChoice as_shown = choose_of(
      settings, budget, first, [&](const MeasuredSetting& setting) { return setting.quality.filter == filter; });
  if (as_shown.holds_rate) {
    return as_shown;
  }
  const BudgetChoice any = choose_of(settings, budget, first, [](const MeasuredSetting&) { return true; });
  return any.holds_rate && any.holds_error == as_shown.holds_error ? any : as_shown;
}

}  // namespace ergodome
