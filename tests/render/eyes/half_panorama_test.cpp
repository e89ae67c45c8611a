#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "content/show/reading/show_reader.h"
#include "render/frame/show_renderer.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

constexpr int half_size_px = 96;

//! Returns a show with everything that a picture can contain, and the given additional lines.
Show panorama_of(const std::string& view, const std::string& more) {
  Show show = parse_show(
      "[hole]\nspin = 0.9\n[[camera.key]]\nr = 9\ntheta_deg = 70\nyaw_deg = 50\n[sky]\nstars = \"bright_stars\"\n"
      "[[shells]]\nradius = 6\nline_width_deg = 4\nspacing_deg = 20\n"
      "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nsize = 2\nposition = [7, 5, 3]\n"
      "[view]\nprojection = \"equirect\"\n" +
          view + more,
      "panorama.toml");
  show.sky.map = test::tiny_sky();
  return show;
}

//! Returns the mean difference of a picture of half the sky and the middle of one of the whole sky,
//! relative to their mean light.
double difference_from_middle(const Picture& half, const Picture& whole) {
  double difference = 0.0;
  double light = 0.0;
  for (int y = 0; y < half.height; ++y) {
    for (int i = 0; i < 4 * half.width; ++i) {
      const std::size_t at = std::size_t{4} * y * half.width + i;
      const std::size_t at_whole = std::size_t{4} * (y * whole.width + half.width / 2) + i;
      difference += std::abs(static_cast<double>(half.rgba[at]) - static_cast<double>(whole.rgba[at_whole]));
      light += static_cast<double>(half.rgba[at]);
    }
  }
  return difference / light;
}

//! Compares the pictures of all eyes.
void expect_the_middle(const std::string& more) {
  SCOPED_TRACE(more);
  ShowRenderer of_half(panorama_of("fov_deg = 180\n", more), Backend::cpu, LensChoice::direct);
  ShowRenderer of_whole(panorama_of("", more), Backend::cpu, LensChoice::direct);
  const auto half = of_half.render(0.0, {ViewMode::sky, half_size_px});
  const auto whole = of_whole.render(0.0, {ViewMode::sky, 2 * half_size_px});
  ASSERT_EQ(half.size(), whole.size());
  for (std::size_t eye = 0; eye < half.size(); ++eye) {
    ASSERT_EQ(half[eye].picture.width, half_size_px);
    ASSERT_EQ(half[eye].picture.height, whole[eye].picture.height);
    EXPECT_LT(difference_from_middle(half[eye].picture, whole[eye].picture), 1e-3) << eye;
  }
}

TEST(HalfPanorama, IsTheMiddleOfTheWholeOne) { expect_the_middle(""); }

TEST(HalfPanorama, IsTheMiddleOfTheWholeOneForTurningEyes) {
  expect_the_middle("[stereo]\nlayout = \"separate\"\nmodel = \"omni\"\nbaseline = 0.4\n");
}

}  // namespace
}  // namespace ergodome
