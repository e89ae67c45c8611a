#include "calibration/warps/blend_map.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

BlendMap grey(int width, int height, std::vector<float> values) { return {width, height, 1, 8, std::move(values)}; }

TEST(BlendMapShape, IsThatOfARasterInAnySize) {
  EXPECT_TRUE(has_shape_of(grey(1920, 1080, {}), 1920, 1080));
  EXPECT_TRUE(has_shape_of(grey(480, 270, {}), 1920, 1080));
  EXPECT_TRUE(has_shape_of(grey(100, 56, {}), 1920, 1080)) << "56.25, rounded";
  EXPECT_FALSE(has_shape_of(grey(512, 512, {}), 1920, 1080));
  EXPECT_FALSE(has_shape_of(grey(1080, 1920, {}), 1920, 1080));
}

TEST(BlendMapShape, IsKeptWhereItIsTheRasters) {
  const BlendMap mask = grey(4, 2, {0, 1, 0, 1, 1, 0, 1, 0});
  EXPECT_EQ(in_shape_of(mask, 8, 4).width, 4);
  EXPECT_EQ(in_shape_of(mask, 8, 4).values, mask.values);
}

TEST(BlendMapShape, IsMadeTheRastersBySamplesBetween) {
  // In each row, the mask rises from 0 on the left to 1 on the right.
  const BlendMap shaped = in_shape_of(
      grey(4, 4,
           {0.0F, 0.25F, 0.75F, 1.0F, 0.0F, 0.25F, 0.75F, 1.0F, 0.0F, 0.25F, 0.75F, 1.0F, 0.0F, 0.25F, 0.75F, 1.0F}),
      8, 2);
  ASSERT_EQ(shaped.width, 8);
  ASSERT_EQ(shaped.height, 2);
  ASSERT_EQ(shaped.values.size(), 16U);
  EXPECT_FLOAT_EQ(shaped.values[0], 0.0F);
  EXPECT_FLOAT_EQ(shaped.values[3], 0.375F);
  EXPECT_FLOAT_EQ(shaped.values[7], 1.0F);
  EXPECT_FLOAT_EQ(shaped.values[8 + 4], 0.625F);
}

}  // namespace
}  // namespace ergodome
