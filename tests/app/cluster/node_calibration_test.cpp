#include "app/player/node_calibration.h"

#include <gtest/gtest.h>

#include "kernels/core/error.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {
namespace {

DomeSetup two_nodes() {
  std::string text = "[dome]\nradius_m = 5\n[cluster]\nkey = \"dome.key\"\n";
  for (const char* const node : {"left", "right"}) {
    text += "[[projector]]\nname = \"at the " + std::string(node) + "\"\nnode = \"" + node +
            "\"\npitch_deg = 40\nyaw_deg = " + (std::string(node) == "left" ? "-40" : "40") +
            "\nfrustum = { left_deg = -50, right_deg = 50, up_deg = 40, down_deg = -40 }\nresolution_px = [32, 24]\n";
  }
  return parse_dome_setup(text, "dome.toml", NamedFiles::unchecked);
}

ClusterFrame pattern_frame(std::uint32_t calibration, ClusterPattern pattern = ClusterPattern::test_pattern) {
  ClusterFrame frame;
  frame.pattern = pattern;
  frame.pattern_kind = static_cast<int>(TestPattern::white);
  frame.calibration = calibration;
  return frame;
}

TEST(NodeCalibration, FollowsTheMasterAndReturnsToTheSetup) {
  const DomeSetup read = two_nodes();
  NodeCalibration node(read, "right");
  EXPECT_FALSE(node.follow(pattern_frame(0), {})) << "nothing changes without a calibration";
  DomeSetup changed = read;
  changed.projectors[1].gain = {0.5, 1.0, 1.0};
  ClusterCalibration calibration{1, to_toml(changed), std::vector<GridOffsets>(2), {"1: left", "2: right"}};
  calibration.offsets[1].move(0, 0.05, 0.0);
  EXPECT_TRUE(node.follow(pattern_frame(1), calibration));
  ASSERT_EQ(node.pictures().size(), 1U);
  EXPECT_EQ(node.pictures()[0].name, "at the right");
  EXPECT_EQ(node.pictures()[0].gain.x, 0.5);
  EXPECT_EQ(node.pictures()[0].offsets, calibration.offsets[1]);
  EXPECT_EQ(node.texts(), std::vector<std::string>{"2: right"});

  calibration.version = 2;
  calibration.texts[1] = "adjusted";
  EXPECT_FALSE(node.follow(pattern_frame(2), calibration)) << "only the text is new";
  EXPECT_EQ(node.texts(), std::vector<std::string>{"adjusted"});

  EXPECT_TRUE(node.follow(pattern_frame(0), calibration));
  EXPECT_EQ(node.pictures()[0].gain.x, 1.0);
  EXPECT_TRUE(node.texts().empty());
}

TEST(NodeCalibration, RefusesAnotherNumberOfProjectors) {
  NodeCalibration node(two_nodes(), "right");
  DomeSetup other = two_nodes();
  other.projectors.pop_back();
  EXPECT_THROW(node.follow(pattern_frame(1), ClusterCalibration{1, to_toml(other), std::vector<GridOffsets>(1), {}}),
               Error);
}

TEST(NodeCalibration, DrawsPatternsAndNumbers) {
  NodeCalibration node(two_nodes(), "right");
  EXPECT_FALSE(node.pattern_of(ClusterFrame()));
  const auto white = node.pattern_of(pattern_frame(0));
  ASSERT_TRUE(white);
  const Picture picture = white(16);
  EXPECT_EQ(picture.width, 16);
  EXPECT_GT(picture.rgba[4 * (8 * 16 + 8)], 0.9F);
  ClusterFrame unknown = pattern_frame(0);
  unknown.pattern_kind = 200;
  EXPECT_EQ(node.pattern_of(unknown)(16).rgba[4 * (8 * 16 + 8)], 0.0F);

  EXPECT_FALSE(node.rasters_change(pattern_frame(0)));
  const ClusterFrame numbers = pattern_frame(0, ClusterPattern::projector_numbers);
  EXPECT_TRUE(node.rasters_change(numbers));
  ASSERT_EQ(node.rasters(numbers).size(), 1U);
  EXPECT_EQ(node.rasters(numbers)[0].width, 32);
  EXPECT_TRUE(node.rasters_change(pattern_frame(0)));
  EXPECT_TRUE(node.rasters(pattern_frame(0)).empty());
}

}  // namespace
}  // namespace ergodome
