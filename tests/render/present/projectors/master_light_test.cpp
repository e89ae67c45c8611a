#include "render/present/projectors/master_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace ergodome {
namespace {

//! Fills memory with NaN and frees it, so that the next allocations contain NaN.
void spoil_memory() {
  constexpr std::size_t blocks = 64;
  std::unique_ptr<std::vector<float>> spoilt[blocks];
  for (std::size_t i = 0; i < blocks; ++i) {
    spoilt[i] = std::make_unique<std::vector<float>>((4 * (32 * 32 + 1)) >> (2 * (i % 6)),
                                                     std::numeric_limits<float>::quiet_NaN());
  }
}

TEST(MasterLight, IsDarkWhereNobodyHasAskedForIt) {
  spoil_memory();
  const MasterLight light(LightTiles(32, 32), Backend::cpu);
  for (int i = 0; i < light.levels().count; ++i) {
    const LightLevel& level = light.levels().level[i];
    for (int k = 0; k < 4 * level.width * level.height; ++k) {
      ASSERT_EQ(level.rgba[k], 0.0F) << i;
    }
  }
}

}  // namespace
}  // namespace ergodome
