#include "calibration/corner_offsets.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

const CornerOffsets nudged = {{0.02, -0.1, 0.25, 0.05}, {-0.03, 0.04, 0.2, -0.25}};

TEST(CornerOffsets, CornersGoWhereTheyAreSent) {
  const RasterPlace corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    const RasterPlace place = moved_place(nudged, corners[i]);
    EXPECT_DOUBLE_EQ(place.x, corners[i].x + nudged.right[i]);
    EXPECT_DOUBLE_EQ(place.y, corners[i].y + nudged.down[i]);
  }
}

TEST(CornerOffsets, TheMiddleGoesByTheirMean) {
  const RasterPlace middle = moved_place(nudged, {0.5, 0.5});
  EXPECT_NEAR(middle.x, 0.5 + (0.02 - 0.1 + 0.25 + 0.05) / 4, 1e-15);
  EXPECT_NEAR(middle.y, 0.5 + (-0.03 + 0.04 + 0.2 - 0.25) / 4, 1e-15);
}

TEST(CornerOffsets, EveryPlaceComesBack) {
  CornerOffsets farthest;
  farthest.right = {0.25, -0.25, -0.25, 0.25};
  farthest.down = {-0.25, 0.25, -0.25, 0.25};
  for (const CornerOffsets& corners : {nudged, farthest}) {
    for (int i = 0; i <= 100; ++i) {
      const int row = i / 11;
      const RasterPlace place = {(i % 11) / 10.0, row / 9.0};
      const RasterPlace there = moved_place(corners, place);
      const RasterPlace back = moved_back(corners, there);
      EXPECT_NEAR(back.x, place.x, 1e-9);
      EXPECT_NEAR(back.y, place.y, 1e-9);
    }
  }
}

TEST(CornerOffsets, MasksGoAlong) {
  BlendMap mask = {100, 50, 1, 8, std::vector<float>(5000)};
  for (int i = 0; i < 5000; ++i) {
    mask.values[static_cast<std::size_t>(i)] = i % 100 < 50 ? 0.0F : 1.0F;
  }
  CornerOffsets aside;
  aside.right = {0.1, 0.1, 0.1, 0.1};
  const BlendMap moved = moved_mask(aside, mask);
  EXPECT_EQ(moved.values[25 * 100 + 55], 0.0F);
  EXPECT_EQ(moved.values[25 * 100 + 65], 1.0F);
  EXPECT_EQ(moved_mask({}, mask).values, mask.values);
}

}  // namespace
}  // namespace ergodome
