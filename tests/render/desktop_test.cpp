#include "render/present/desktop.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

TEST(Desktop, RectanglesOverlapWhereTheyShareAPixel) {
  const DesktopRectangle middle = {100, 100, 50, 40};
  EXPECT_TRUE(overlap(middle, middle));
  EXPECT_TRUE(overlap(middle, {149, 139, 10, 10}));
  EXPECT_TRUE(overlap(middle, {0, 0, 1000, 1000}));
  EXPECT_FALSE(overlap(middle, {150, 100, 10, 10}));
  EXPECT_FALSE(overlap(middle, {100, 140, 10, 10}));
  EXPECT_FALSE(overlap(middle, {-50, -50, 150, 500}));
  EXPECT_FALSE(overlap(middle, {110, 110, 0, 0}));
}

TEST(Desktop, MonitorsAreListedWithTheirPlaces) {
  const std::vector<DesktopMonitor> two = {{"DP-1", {0, 0, 1920, 1080}, {}}, {"HDMI-1", {1920, -10, 1280, 800}, {}}};
  EXPECT_EQ(monitor_list(two), "0 (DP-1, 1920 x 1080 at 0, 0), 1 (HDMI-1, 1280 x 800 at 1920, -10)");
}

}  // namespace
}  // namespace ergodome
