#include "render/accuracy/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ergodome {

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) {
    return 0.0;
  }
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  const auto position = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  return sorted[std::min(position, sorted.size() - 1)];
}

ErrorSummary summary_of(std::vector<double> errors) {
  for (double& error : errors) {
    error = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
  }
  std::sort(errors.begin(), errors.end());
  return {errors.size(), quantile(errors, 0.5), quantile(errors, 0.99), quantile(errors, 0.999), quantile(errors, 1.0)};
}

Spread spread_of(std::vector<double> runs) {
  if (runs.empty()) {
    return {};
  }
  std::sort(runs.begin(), runs.end());
  const std::size_t middle = runs.size() / 2;
  const double median = runs.size() % 2 == 1 ? runs[middle] : 0.5 * (runs[middle - 1] + runs[middle]);
  return {median, runs.front(), runs.back(), static_cast<int>(runs.size())};
}

Spread ratio_of(const std::vector<double>& runs, const std::vector<double>& other) {
  std::vector<double> ratios;
  ratios.reserve(std::min(runs.size(), other.size()));
  for (std::size_t i = 0; i < std::min(runs.size(), other.size()); ++i) {
    ratios.push_back(runs[i] / other[i]);
  }
  return spread_of(std::move(ratios));
}

std::vector<bool> pareto_front(const std::vector<double>& cost, const std::vector<double>& error) {
  const std::size_t count = std::min(cost.size(), error.size());
  std::vector<bool> front(count);
  for (std::size_t i = 0; i < count; ++i) {
    bool beaten = !std::isfinite(cost[i]) || !std::isfinite(error[i]);
    for (std::size_t j = 0; j < count && !beaten; ++j) {
      beaten = cost[j] <= cost[i] && error[j] <= error[i] && (cost[j] < cost[i] || error[j] < error[i]);
    }
    front[i] = !beaten;
  }
  return front;
}

}  // namespace ergodome
