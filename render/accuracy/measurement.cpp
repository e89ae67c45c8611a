#include "render/accuracy/measurement.h"

#include <algorithm>

namespace ergodome {

const char* unit_name(ErrorUnit unit) { return unit == ErrorUnit::pixels ? "px" : "%"; }

std::vector<double> Measurement::anew_ms() const {
  std::vector<double> sum = frame_ms;
  for (std::size_t i = 0; i < sum.size() && i < prepare_ms.size(); ++i) {
    sum[i] += prepare_ms[i];
  }
  return sum;
}

double time_spread(const AccuracyReport& report) {
  std::vector<double> spreads;
  for (const AccuracyAxis& axis : report.axes) {
    for (const Measurement& choice : axis.choices) {
      const Spread time = spread_of(choice.frame_ms);
      if (time.runs >= 2 && time.least > 0.0) {
        spreads.push_back(time.greatest / time.least);
      }
    }
  }
  std::ranges::sort(spreads);
  return quantile(spreads, 0.5);
}

bool is_too_busy(const AccuracyReport& report) { return time_spread(report) > busy_time_spread; }

void mark_pareto(AccuracyAxis& axis) {
  std::vector<double> error;
  std::vector<double> ready;
  std::vector<double> anew;
  for (const Measurement& choice : axis.choices) {
    error.push_back(choice.error.p99);
    ready.push_back(spread_of(choice.frame_ms).median);
    anew.push_back(spread_of(choice.anew_ms()).median);
  }
  const std::vector<bool> best_ready = pareto_front(ready, error);
  const std::vector<bool> best_anew = pareto_front(anew, error);
  for (std::size_t i = 0; i < axis.choices.size(); ++i) {
    axis.choices[i].best_ready = best_ready[i];
    axis.choices[i].best_anew = best_anew[i];
  }
}

const AccuracyAxis* find_axis(const AccuracyReport& report, const std::string& name) {
  for (const AccuracyAxis& axis : report.axes) {
    if (axis.name == name) {
      return &axis;
    }
  }
  return nullptr;
}

}  // namespace ergodome
