#include "render/diagram/spread_choice.h"

#include <algorithm>
#include <limits>

namespace ergodome {

std::vector<std::size_t> spread_choice(const std::vector<Vector3<double>>& positions, std::size_t count) {
  Vector3<double> middle{0.0, 0.0, 0.0};
  for (const Vector3<double>& position : positions) {
    middle = middle + (1.0 / static_cast<double>(positions.size())) * position;
  }
  const auto square = [](const Vector3<double>& v) { return dot(v, v); };
  std::vector<double> nearest;
  nearest.reserve(positions.size());
  for (const Vector3<double>& position : positions) {
    nearest.push_back(square(position - middle));
  }
  std::vector<std::size_t> chosen;
  while (chosen.size() < std::min(count, positions.size())) {
    const auto next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
    if (!chosen.empty() && !(nearest[next] > 0.0)) {
      break;
    }
    if (chosen.empty()) {
      std::ranges::fill(nearest, std::numeric_limits<double>::max());
    }
    chosen.push_back(next);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      nearest[i] = std::min(nearest[i], square(positions[i] - positions[next]));
    }
    nearest[next] = -1.0;
  }
  return chosen;
}

}  // namespace ergodome
