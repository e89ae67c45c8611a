#include "render/backend/cached_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace ergodome {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

TEST(CachedMemory, IsGivenToTheNextThatAsksForAsMuch) {
  void* const first = take_large_block(9 * mebibyte);
  return_large_block(first, 9 * mebibyte);
  void* const second = take_large_block(9 * mebibyte);
  EXPECT_EQ(second, first);
  return_large_block(second, 9 * mebibyte);
}

TEST(CachedMemory, IsNotGivenToTwo) {
  void* const first = take_large_block(8 * mebibyte);
  void* const second = take_large_block(8 * mebibyte);
  EXPECT_NE(first, second);
  std::memset(first, 1, 8 * mebibyte);
  std::memset(second, 2, 8 * mebibyte);
  EXPECT_EQ(static_cast<const unsigned char*>(first)[8 * mebibyte - 1], 1);
  return_large_block(first, 8 * mebibyte);
  return_large_block(second, 8 * mebibyte);
}

TEST(CachedMemory, OfManySizesIsBounded) {
  std::vector<void*> blocks;
  blocks.reserve(12);
  for (std::size_t i = 0; i < 12; ++i) {
    blocks.push_back(take_large_block((20 + 2 * i) * mebibyte));
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    return_large_block(blocks[i], (20 + 2 * i) * mebibyte);
  }
  EXPECT_LE(cached_large_blocks(), 4U);
}

TEST(CachedMemory, LiesOnLargePages) {
  void* const block = take_large_block(5 * mebibyte);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % (2 * mebibyte), 0U);
  return_large_block(block, 5 * mebibyte);
}

TEST(PixelValues, OfOnePictureServeTheNext) {
  const float* before = nullptr;
  {
    PixelValues values;
    values.resize(4 * mebibyte);
    before = values.data();
  }
  PixelValues values;
  values.resize(4 * mebibyte);
  EXPECT_EQ(values.data(), before);
}

}  // namespace
}  // namespace ergodome
