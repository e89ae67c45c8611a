#include "render/frame/show_renderer.h"

#include <gtest/gtest.h>

#include <string>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"

namespace ergodome {
namespace {

Show stereo_show(const std::string& layout, double baseline) {
  return parse_show(
      "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 12\n[sky]\nmap = \"grid\"\n[view]\nprojection = \"pinhole\"\n"
      "size_px = 64\n[stereo]\nlayout = \"" +
          layout + "\"\nbaseline = " + std::to_string(baseline) + "\n",
      "stereo.toml");
}

TEST(ShowRenderer, SideBySideHoldsTheTwoSeparateEyes) {
  ShowRenderer joined(stereo_show("side_by_side", 0.5), Backend::cpu);
  ShowRenderer apart(stereo_show("separate", 0.5), Backend::cpu);
  const auto both = joined.render(0.0, {});
  const auto each = apart.render(0.0, {});
  ASSERT_EQ(both.size(), 1U);
  ASSERT_EQ(each.size(), 2U);
  EXPECT_EQ(each[0].part, FramePart::left);
  EXPECT_EQ(both[0].picture.width, 128);
  for (const std::size_t y : {5U, 40U}) {
    EXPECT_EQ(both[0].picture.rgba[4 * (128 * y + 10)], each[0].picture.rgba[4 * (64 * y + 10)]);
    EXPECT_EQ(both[0].picture.rgba[4 * (128 * y + 64 + 10)], each[1].picture.rgba[4 * (64 * y + 10)]);
  }
}

//! Returns a dome show with 64² pixels of a hole in front of the grid sky. Its shadow is about 14
//! pixels wide.
Show dome_of_64_px() {
  return parse_show(
      "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 24\n[sky]\nmap = \"grid\"\n[view]\ntilt_deg = 90\nsize_px = "
      "64\n",
      "dome.toml");
}

TEST(ShowRenderer, AlphaIsTheDomesCircleWithTheShadow) {
  const Picture lens = ShowRenderer(dome_of_64_px(), Backend::cpu).render(0.0, {})[0].picture;
  ViewChoice choice;
  choice.alpha = true;
  const Picture picture = ShowRenderer(dome_of_64_px(), Backend::cpu).render(0.0, choice)[0].picture;
  double area = 0.0;
  double shadow = 0.0;
  for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
    area += picture.rgba[at + 3];
    shadow += picture.rgba[at + 3] - lens.rgba[at + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(picture.rgba[at + c], lens.rgba[at + c]);
    }
  }
  EXPECT_NEAR(area, 32.0 * 32.0 * pi, 2.0);
  EXPECT_GT(shadow, 20.0);
}

TEST(ShowRenderer, TintedEyesShowWhoseShadowItIs) {
  Show show = dome_of_64_px();
  show.stereo.layout = StereoLayout::separate;
  show.stereo.tint_eyes = true;
  const auto eyes = ShowRenderer(show, Backend::cpu).render(0.0, {});
  // The dome and the camera are tilted so that the hole is in the middle of the picture.
  const std::size_t middle = 4 * (32 * 64 + 32);
  EXPECT_GT(eyes[0].picture.rgba[middle], 2.0F * eyes[0].picture.rgba[middle + 1]);
  EXPECT_GT(eyes[1].picture.rgba[middle + 1], 2.0F * eyes[1].picture.rgba[middle]);
}

double mean_dark_x(const Picture& picture) {
  double sum = 0.0;
  double weight = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double dark = 1.0 - picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + 3];
      sum += dark * x;
      weight += dark;
    }
  }
  return sum / weight;
}

TEST(ShowRenderer, TheHoleStandsFurtherRightInTheLeftEye) {
  const auto eyes = ShowRenderer(stereo_show("separate", 1.0), Backend::cpu).render(0.0, {});
  EXPECT_GT(mean_dark_x(eyes[0].picture), mean_dark_x(eyes[1].picture) + 1.0);
}

TEST(ShowRenderer, BaselineZeroGivesBothEyesTheSamePicture) {
  const auto eyes = ShowRenderer(stereo_show("separate", 0.0), Backend::cpu).render(0.0, {});
  EXPECT_EQ(eyes[0].picture.rgba, eyes[1].picture.rgba);
}

TEST(ShowRenderer, BaselineLargerThanTheDistanceStillGivesPictures) {
  const auto eyes = ShowRenderer(stereo_show("separate", 40.0), Backend::cpu).render(0.0, {});
  EXPECT_EQ(eyes.size(), 2U);
}

}  // namespace
}  // namespace ergodome
