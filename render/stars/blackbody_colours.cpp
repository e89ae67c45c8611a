#include "render/stars/blackbody_colours.h"

#include <cmath>
#include <vector>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr double coldest_k = 300.0;
constexpr double hottest_k = 1e7;

}  // namespace

BlackbodyColours::BlackbodyColours(Backend backend)
    : first_(static_cast<float>(std::log(coldest_k))),
      step_(static_cast<float>(std::log(hottest_k / coldest_k) / (count - 1))) {
  std::vector<float> entries(4 * static_cast<std::size_t>(count));
  parallel_for(count, 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      // At the very place that the kernels take an entry for.
      const double log_temperature = static_cast<double>(first_) + i * static_cast<double>(step_);
      const Vector3<double> xyz = blackbody_tristimulus(std::exp(log_temperature));
      float* entry = entries.data() + 4 * static_cast<std::size_t>(i);
      entry[0] = static_cast<float>(std::log(xyz.y));
      entry[1] = static_cast<float>(xyz.x / xyz.y);
      entry[2] = static_cast<float>(xyz.z / xyz.y);
    }
  });
  entries_ = Buffer<float>(backend, entries, "blackbody table");
}

}  // namespace ergodome
