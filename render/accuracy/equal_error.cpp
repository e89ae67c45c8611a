#include "render/accuracy/equal_error.h"

#include <algorithm>

namespace ergodome {

namespace {

std::vector<double> runs_of(const Measurement& choice, FrameCost cost) {
  return cost == FrameCost::ready ? choice.frame_ms : choice.anew_ms();
}

}  // namespace

double cost_ms(const Measurement& choice, FrameCost cost) { return spread_of(runs_of(choice, cost)).median; }

const Measurement* cheapest_within(const AccuracyAxis& axis, double most, FrameCost cost, const std::string& method) {
  const Measurement* best = nullptr;
  for (const Measurement& choice : axis.choices) {
    const bool asked = method.empty() || choice.method == method;
    if (asked && choice.error.count > 0 && choice.error.p99 <= most &&
        (best == nullptr || cost_ms(choice, cost) < cost_ms(*best, cost))) {
      best = &choice;
    }
  }
  return best;
}

std::vector<EqualErrorRow> compare_at(const AccuracyAxis& axis, double most, FrameCost cost) {
  const Measurement* const base = cheapest_within(axis, most, cost, axis.base);
  std::vector<EqualErrorRow> rows;
  for (const Measurement& choice : axis.choices) {
    const auto known = [&](const EqualErrorRow& row) { return row.method == choice.method; };
    if (std::ranges::any_of(rows, known)) {
      continue;
    }
    EqualErrorRow row{choice.method, cheapest_within(axis, most, cost, choice.method), {}};
    if (row.choice != nullptr && base != nullptr) {
      row.ratio = ratio_of(runs_of(*row.choice, cost), runs_of(*base, cost));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ergodome
