#include "render/passes/stars/drawing/blackbody_colours.h"

#include <cmath>
#include <vector>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr double coldest_k = 300.0;
constexpr double hottest_k = 1e7;

float first_entry() { return static_cast<float>(std::log(coldest_k)); }

float entry_step() { return static_cast<float>(std::log(hottest_k / coldest_k) / (BlackbodyColours::count - 1)); }

//! Returns the table, computed once and shared by all instances: it takes a million evaluations of
//! Planck's law.
const std::vector<float>& shared_entries() {
  static const std::vector<float> table = [] {
    constexpr int count = BlackbodyColours::count;
    const float first = first_entry();
    const float step = entry_step();
    std::vector<float> entries(4 * static_cast<std::size_t>(count));
    parallel_for(count, 64, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        // ln of the temperature that the kernels assign to the entry, with the rounding errors of
        // `first` and `step`, which are floats.
        const double log_temperature = static_cast<double>(first) + i * static_cast<double>(step);
        const Vector3<double> xyz = blackbody_tristimulus(std::exp(log_temperature));
        float* entry = entries.data() + 4 * static_cast<std::size_t>(i);
        entry[0] = static_cast<float>(std::log(xyz.y));
        entry[1] = static_cast<float>(xyz.x / xyz.y);
        entry[2] = static_cast<float>(xyz.z / xyz.y);
      }
    });
    return entries;
  }();
  return table;
}

}  // namespace

BlackbodyColours::BlackbodyColours(Backend backend)
    : first_(first_entry()), step_(entry_step()), entries_(backend, shared_entries(), "blackbody table") {}

}  // namespace ergodome
