#include "kernels/launch/large_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace ergodome {
namespace {

TEST(LargeMemory, HoldsVectorsOfAnySizeWhileTheyGrow) {
  LargeVector<std::uint32_t> numbers;
  constexpr std::uint32_t count = 3 * min_large_bytes / sizeof(std::uint32_t);
  for (std::uint32_t i = 0; i < count; ++i) {
    numbers.push_back(i);
  }
  const auto sum = std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
  EXPECT_EQ(sum, std::uint64_t{count} * (count - 1) / 2);
  numbers.resize(1);
  numbers.shrink_to_fit();
  EXPECT_EQ(numbers.front(), 0U);
}

TEST(LargeMemory, OfAVectorIsZeroedWhereAskedFor) {
  const LargeVector<float> zeros(min_large_bytes);
  EXPECT_EQ(zeros.front(), 0.0F);
  EXPECT_EQ(zeros.back(), 0.0F);
}

}  // namespace
}  // namespace ergodome
