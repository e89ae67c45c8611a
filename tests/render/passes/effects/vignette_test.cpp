#include "render/passes/effects/vignette.h"

#include <gtest/gtest.h>

#include "kernels/projection/make_projection.h"
#include "render/passes/pass.h"

namespace ergodome {
namespace {

Show show_with_vignette(double strength) {
  Show show;
  show.view.projection = ViewProjection::pinhole;
  show.view.vignette = strength;
  return show;
}

TEST(Vignette, TakesNoLightFromTheMiddleAndItsStrengthAtTheEdge) {
  EXPECT_DOUBLE_EQ(vignette_light(0.8, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(vignette_light(0.8, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(vignette_light(0.8, 0.75), 0.6);
  EXPECT_DOUBLE_EQ(vignette_light(0.8, 1.0), 1.0 - 0.8);
  EXPECT_DOUBLE_EQ(vignette_light(0.8, 1.4), 1.0 - 0.8);
}

TEST(Vignette, DarkensColorsSymmetricallyAndKeepsCoverage) {
  const Show show = show_with_vignette(1.0);
  const std::unique_ptr<Pass> pass = make_vignette_pass({show, Backend::cpu});
  ASSERT_NE(pass, nullptr);
  EyePicture wanted;
  wanted.projection = make_pinhole_projection(8, 6, 1.0);
  wanted.settings.show = &show;
  Picture picture;
  picture.width = 8;
  picture.height = 6;
  picture.rgba.assign(4UL * 8 * 6, 1.0F);
  pass->prepare(wanted)->finish(picture);
  const auto value = [&](int x, int y, int channel) {
    return picture.rgba[4 * static_cast<std::size_t>(8 * y + x) + static_cast<std::size_t>(channel)];
  };
  EXPECT_EQ(value(0, 0, 0), 0.0F);
  EXPECT_EQ(value(0, 0, 3), 1.0F);
  EXPECT_EQ(value(3, 2, 1), 1.0F);
  EXPECT_EQ(value(0, 3, 2), value(7, 2, 2));
}

TEST(Vignette, IsNotMadeWithoutStrengthAndForViewsWithoutAnEdge) {
  EXPECT_EQ(make_vignette_pass({show_with_vignette(0.0)}), nullptr);
  Show show = show_with_vignette(1.0);
  EXPECT_FALSE(needs_vignette(show, ViewMode::steps));
  show.view.projection = ViewProjection::equirect;
  EXPECT_EQ(make_vignette_pass({show}), nullptr);
}

}  // namespace
}  // namespace ergodome
