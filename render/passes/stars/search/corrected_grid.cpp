#include "render/passes/stars/search/corrected_grid.h"

#include <algorithm>
#include <cmath>

#include "render/lens/grid/grid_tracer.h"

namespace ergodome {

namespace {

constexpr float unknown = 1e30F;

}  // namespace

CorrectedGrid::CorrectedGrid(const LensStation& station)
    : leaves_(station.leaves), nodes_(station.traced_nodes), checks_(station.leaf_displacements) {
  for (const LeafBox& box : leaf_boxes(station)) {
    for (const double number : {box.gamma_turns, box.s, box.width_turns, box.height}) {
      boxes_.push_back(static_cast<float>(number));
    }
  }
}

LeafErrors CorrectedGrid::errors(int leaf) const {
  if (checks_.empty()) {
    return {unknown, unknown};
  }
  const float* const gamma = checks_.data() + static_cast<std::ptrdiff_t>(2) * checks_a_cell * leaf;
  const float* const s = gamma + checks_a_cell;
  LeafErrors errors{0.0F, 0.0F};
  for (int check = 0; check < checks_a_cell; ++check) {
    const bool inside = check == 0 || check == checks_a_cell - 1;
    const float displacement = std::abs(gamma[check]) + std::abs(s[check]);
    errors.displaced = std::max(errors.displaced, inside ? inner_share * displacement : displacement);
    if (inside) {
      const float position = check == 0 ? inner_check : 1.0F - inner_check;
      const LeafDisplacement by = leaf_displacement(view(host_data), leaf, position, position);
      errors.left = std::max(errors.left, std::abs(gamma[check] - by.along_gamma) + std::abs(s[check] - by.along_s));
    }
  }
  return errors;
}

}  // namespace ergodome
