#include "app/commands/channels/heat_map_options.h"

#include <gmock/gmock.h>

#include <cmath>

#include "app/cli/usage_error.h"
#include "content/images/image_library.h"
#include "kernels/image/color_map.h"
#include "render/output/image_writer.h"
#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

class ViewRanges : public test::CommandLine {
 protected:
  //! Returns the color, as linear light, of a pixel above the color bar.
  [[nodiscard]] Vector3<float> color_of(const std::string& file, int size_px) const {
    std::string problem;
    const auto input = image_library().open((folder_ / file).string(), {}, problem);
    std::vector<float> rgb(3 * static_cast<std::size_t>(size_px * size_px));
    if (!input || !input->read_all(3, rgb.data())) {
      ADD_FAILURE() << problem;
      return {};
    }
    const std::size_t at = 3 * static_cast<std::size_t>(20 * size_px + 20);
    return {rgb[at], rgb[at + 1], rgb[at + 2]};
  }
};

TEST_F(ViewRanges, MoveTheColoursOfAHeatMap) {
  // A static observer at 4 M from a hole without spin sees the sky blueshifted by √2. The color of
  // this value is at (log √2 - log 1) / (log 4 - log 1) = 1/4 of the color bar for the range 1 to
  // 4, and at half of the bar for the default range.
  write("static.toml", R"(
title = "Static"
[hole]
spin = 0
[camera]
observer = "static"
[[camera.key]]
r = 4
[sky]
map = "black"
[view]
projection = "pinhole"
fov_deg = 150
size_px = 200
)");
  ASSERT_EQ(run("render static.toml --out f --frames 1 --view g --view-range 1:4 --format exr"), 0) << output_;
  const Vector3<float> shown = shift_color(0.25F);
  const Vector3<float> seen = color_of("f/static_000001.exr", 200);
  EXPECT_NEAR(seen.x, srgb_decoded(shown.x), 2e-3F);
  EXPECT_NEAR(seen.y, srgb_decoded(shown.y), 2e-3F);
  EXPECT_NEAR(seen.z, srgb_decoded(shown.z), 2e-3F);
  EXPECT_EQ(metadata_of_image(folder_ / "f/static_000001.exr", "view"), "g");
  EXPECT_EQ(metadata_of_image(folder_ / "f/static_000001.exr", "view_range"), "1 4");
}

TEST(ViewRange, IsTwoNumbersTheSmallerOneFirst) {
  const std::optional<ViewRange> range = view_range("0.5:2e1", ViewMode::frequency_ratio, false);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->low, 0.5);
  EXPECT_EQ(range->high, 20.0);
  EXPECT_FALSE(view_range("", ViewMode::magnification, false));
  EXPECT_TRUE(view_range("-1:2", ViewMode::image_order, false));
  EXPECT_TRUE(view_range("0:40", ViewMode::steps, false));
  for (const char* text :
       {"1", ":", "1:", ":2", "2:1", "1:1", "nan:1", "1:inf", "1:2:3", "1,2", "a:b", "0:2", "-1:1"}) {
    EXPECT_THROW(view_range(text, ViewMode::magnification, false), UsageError) << text;
  }
  EXPECT_THROW(view_range("0:40", ViewMode::steps, true), UsageError) << "logarithmic with --method";
  EXPECT_THROW(view_range("1:2", ViewMode::sky, false), UsageError);
}

}  // namespace
}  // namespace ergodome
