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
      if (time.runs >= 2 && time.minimum > 0.0) {
        spreads.push_back(time.maximum / time.minimum);
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

namespace {

std::vector<double> runs_of(const Measurement& choice, FrameCost cost) {
  return cost == FrameCost::ready ? choice.frame_ms : choice.anew_ms();
}

}  // namespace

double cost_ms(const Measurement& choice, FrameCost cost) { return spread_of(runs_of(choice, cost)).median; }

const Measurement* cheapest_within(const AccuracyAxis& axis, double maximum, FrameCost cost,
                                   const std::string& method) {
  const Measurement* best = nullptr;
  for (const Measurement& choice : axis.choices) {
    const bool asked = method.empty() || choice.method == method;
    if (asked && choice.error.count > 0 && choice.error.p99 <= maximum &&
        (best == nullptr || cost_ms(choice, cost) < cost_ms(*best, cost))) {
      best = &choice;
    }
  }
  return best;
}

std::vector<EqualErrorRow> compare_at(const AccuracyAxis& axis, double maximum, FrameCost cost) {
  const Measurement* const base = cheapest_within(axis, maximum, cost, axis.base);
  std::vector<EqualErrorRow> rows;
  for (const Measurement& choice : axis.choices) {
    const auto known = [&](const EqualErrorRow& row) { return row.method == choice.method; };
    if (std::ranges::any_of(rows, known)) {
      continue;
    }
    EqualErrorRow row{choice.method, cheapest_within(axis, maximum, cost, choice.method), {}};
    if (row.choice != nullptr && base != nullptr) {
      row.ratio = ratio_of(runs_of(*row.choice, cost), runs_of(*base, cost));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ergodome
