#include "render/present/desktop.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

const std::vector<DesktopMonitor> one_monitor = {{"one", {0, 0, 1920, 1080}, {0, 30, 1920, 1050}}};
const DesktopRectangle small_window = {0, 0, 700, 700};

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

TEST(Desktop, AFreePlaceIsBesideWhatIsTaken) {
  const std::vector<DesktopRectangle> right_is_free = {{0, 0, 640, 480}, {640, 0, 500, 480}};
  EXPECT_EQ(free_rectangle(small_window, one_monitor, right_is_free), (DesktopRectangle{1140, 30, 700, 700}));
  const std::vector<DesktopRectangle> below_is_free = {{0, 0, 960, 300}, {960, 0, 960, 340}};
  EXPECT_EQ(free_rectangle(small_window, one_monitor, below_is_free), (DesktopRectangle{0, 300, 700, 700}));
  const std::vector<DesktopRectangle> left_is_free = {{700, 0, 1220, 1080}};
  EXPECT_EQ(free_rectangle(small_window, one_monitor, left_is_free), (DesktopRectangle{0, 30, 700, 700}));
  const std::vector<DesktopRectangle> steps = {{0, 0, 1920, 200}, {0, 200, 800, 100}};
  EXPECT_EQ(free_rectangle(small_window, one_monitor, steps), (DesktopRectangle{800, 200, 700, 700}));
}

TEST(Desktop, AFreePlaceMayBeOnAnotherMonitor) {
  const std::vector<DesktopMonitor> two = {one_monitor[0], {"two", {-1280, 200, 1280, 800}, {-1280, 200, 1280, 760}}};
  const std::vector<DesktopRectangle> first_is_full = {{0, 0, 1920, 1080}, {-1280, 200, 400, 300}};
  EXPECT_EQ(free_rectangle(small_window, two, first_is_full), (DesktopRectangle{-880, 200, 700, 700}));
}

TEST(Desktop, ThereMayBeNoFreePlace) {
  EXPECT_EQ(free_rectangle(small_window, one_monitor, std::vector<DesktopRectangle>{{600, 300, 720, 300}}),
            std::nullopt);
  EXPECT_EQ(free_rectangle({0, 0, 700, 1080}, one_monitor, {}), std::nullopt);  // higher than the space that bars leave
  EXPECT_EQ(free_rectangle(small_window, {}, {}), std::nullopt);
}

TEST(Desktop, MonitorsAreListedWithTheirPlaces) {
  const std::vector<DesktopMonitor> two = {{"DP-1", {0, 0, 1920, 1080}, {}}, {"HDMI-1", {1920, -10, 1280, 800}, {}}};
  EXPECT_EQ(monitor_list(two), "0 (DP-1, 1920 x 1080 at 0, 0), 1 (HDMI-1, 1280 x 800 at 1920, -10)");
}

}  // namespace
}  // namespace ergodome
