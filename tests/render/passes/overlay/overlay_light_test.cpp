#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "render/output/tone_map.h"
#include "render/patterns/test_pattern.h"
#include "tests/render/passes/overlay/overlay_scene.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): overlays and how they are looked at

TEST_F(Overlays, HaveTheSameLightAtEverySize) {
  const Timeline timeline = captions_of({caption_of("Ergodome")});
  double part = 0.0;
  for (const int size_px : {2048, 1024, 512, 300, 150}) {
    const double now = sum_of_light(drawn(timeline, "", make_dome_projection(size_px, pi, 0.0))) / size_px / size_px;
    part = part > 0.0 ? part : now;
    EXPECT_NEAR(now / part, 1.0, 0.02) << size_px;
  }
}

TEST(PresenceOfAnOverlay, ComesAndGoesSmoothly) {
  const Presence presence = {10.0, 20.0, 2.0, 4.0};
  EXPECT_EQ(presence_at(presence, 9.99), 0.0);
  EXPECT_EQ(presence_at(presence, 10.0), 0.0);
  EXPECT_DOUBLE_EQ(presence_at(presence, 10.5), 3.0 / 16.0 - 2.0 / 64.0);
  EXPECT_DOUBLE_EQ(presence_at(presence, 11.0), 0.5);
  EXPECT_EQ(presence_at(presence, 12.0), 1.0);
  EXPECT_EQ(presence_at(presence, 16.0), 1.0);
  EXPECT_DOUBLE_EQ(presence_at(presence, 18.0), 0.5);
  EXPECT_EQ(presence_at(presence, 20.0), 0.0);
}

TEST(PresenceOfAnOverlay, IsWholeAtOnceWithoutFades) {
  EXPECT_EQ(presence_at({1.0, 2.0, 0.0, 0.0}, 1.0), 1.0);
  EXPECT_EQ(presence_at({1.0, 2.0, 0.0, 0.0}, 2.0), 0.0);
}

//! Draws overlays of a timeline on a screen with uniform light, and returns the displayed value of
//! the middle pixel.
int shown_in_the_middle(const Timeline& timeline, const std::string& folder, float light, const Tone& tone,
                        double time_s = 0.0) {
  const Projection screen = make_pinhole_projection(64, 64, 0.3);
  OverlayPass pass = pass_of(timeline, folder);
  Picture picture = even_picture(screen, light, tone);
  draw(pass, picture, screen, time_s);
  return tone_mapped(picture)[3UL * (32 * 64 + 32)];
}

TEST_F(Overlays, KeepTheirColoursAtEveryToneAndExposure) {
  Timeline grey;
  grey.overlays = {image_at("grey.png", 0.0, 0.0, 10.0)};
  Timeline white;
  white.overlays = {image_at("white.png", 0.0, 0.0, 10.0)};
  for (const ToneCurve curve : {ToneCurve::shoulder, ToneCurve::reinhard, ToneCurve::filmic, ToneCurve::gamma}) {
    for (const float gain : {0.1F, 1.0F, 30.0F}) {
      for (const float light : {0.0F, 0.3F, 50.0F}) {
        const Tone tone = {curve, gain, 4.0F, 2.2F};
        EXPECT_NEAR(shown_in_the_middle(grey, folder_.string(), light, tone), 128, 1);
        EXPECT_EQ(shown_in_the_middle(white, folder_.string(), light, tone), 255);
      }
    }
  }
}

TEST_F(Overlays, CoverTheDisplaysLightByOpacityAndFade) {
  Timeline timeline;
  timeline.overlays = {image_at("white.png", 0.0, 0.0, 10.0)};
  timeline.overlays[0].opacity = 0.5;
  timeline.overlays[0].presence = {0.0, 10.0, 2.0, 2.0};
  // The light is 0.2. White covers half of it at 5 s and, during the fade, a quarter of it at 1 s,
  // in linear light. The sRGB values are calculated by hand.
  EXPECT_NEAR(shown_in_the_middle(timeline, folder_.string(), 0.2F, as_it_is, 5.0), 203, 1);
  EXPECT_NEAR(shown_in_the_middle(timeline, folder_.string(), 0.2F, as_it_is, 1.0), 170, 1);
}

TEST_F(Overlays, OnAHeatMapKeepTheirColours) {
  const Projection screen = make_pinhole_projection(64, 64, 0.3);
  Timeline timeline;
  timeline.overlays = {image_at("grey.png", 0.0, 0.0, 10.0)};
  OverlayPass pass = pass_of(timeline, folder_.string());
  Picture picture = even_picture(screen, 0.7F, {ToneCurve::reinhard, 3.0F});
  picture.heat_range = HeatRange{0.0, 1.0, false};
  draw(pass, picture, screen);
  EXPECT_NEAR(tone_mapped(picture)[3UL * (32 * 64 + 32)], 128, 1);
}

TEST_F(Overlays, HaveNoDarkFringes) {
  // The image is a white disk with a soft rim. In the file, transparent pixels are black.
  constexpr int size = 64;
  Picture disc;
  disc.width = disc.height = size;
  disc.tone = as_it_is;
  for (int i = 0; i < size * size; ++i) {
    const int row = i / size;
    const double radius = std::hypot(i % size - 31.5, row - 31.5);
    const auto alpha = static_cast<float>(std::clamp(0.5 * (24.0 - radius), 0.0, 1.0));
    const float light = alpha > 0.0F ? 1.0F : 0.0F;
    disc.rgba.insert(disc.rgba.end(), {light, light, light, alpha});
  }
  write_picture(folder_ / "disc.png", {ImageFormat::png, ExrCompression::zip, true}, disc, {});
  for (const double width_deg : {3.0, 17.0, 80.0}) {
    Timeline timeline;
    timeline.overlays = {image_at("disc.png", 10.0, 30.0, width_deg)};
    const Projection projection = make_dome_projection(400, pi, 0.0);
    const Picture before = even_picture(projection, 0.4F);
    const Picture after = drawn(timeline, folder_.string(), projection, 0.4F);
    EXPECT_GT(sum_of_light(after), sum_of_light(before) + 10.0);
    for (std::size_t i = 0; i < after.rgba.size(); ++i) {
      ASSERT_GE(after.rgba[i], before.rgba[i] - 2e-4F) << width_deg;
    }
  }
}

TEST_F(Overlays, ThatAreDomemastersComeBackPixelForPixel) {
  ViewSettings view;
  view.tilt_deg = 25.0;
  const Projection projection = make_projection(view, 512, 0.0);
  const Picture master = draw_test_pattern(TestPattern::checker, projection);
  write_picture(folder_ / "master.png", {ImageFormat::png16}, master, {});
  Timeline timeline;
  Overlay overlay;
  overlay.image = "master.png";
  overlay.presence = always;
  overlay.fisheye = true;
  timeline.overlays = {overlay};
  const auto seen = tone_mapped(drawn(timeline, folder_.string(), projection, 0.6F));
  const auto expected = tone_mapped(master);
  int compared = 0;
  for (int i = 0; i < 512 * 512; ++i) {
    const int row = i / 512;
    if (image_coverage(projection, i % 512 + 0.5, row + 0.5) == 1.0) {
      ++compared;
      ASSERT_NEAR(seen[3UL * static_cast<std::size_t>(i)], expected[3UL * static_cast<std::size_t>(i)], 1)
          << i % 512 << " " << row;
    }
  }
  EXPECT_GT(compared, 200000);
}

TEST_F(Overlays, OfANarrowFisheyeEndAtTheirCircle) {
  Timeline timeline;
  Overlay overlay;
  overlay.image = "white.png";
  overlay.presence = always;
  overlay.fisheye = true;
  overlay.fov_deg = 90.0;
  timeline.overlays = {overlay};
  const double covered = sum_of_light(drawn(timeline, folder_.string(), make_dome_projection(400, pi, 0.0)));
  // The fisheye image covers a circle with half the radius of the dome, plus half a pixel.
  EXPECT_NEAR(covered, pi * 100.5 * 100.5, 0.01 * covered);
}

TEST_F(Overlays, GiveTheirAlphaToThePicture) {
  const Projection screen = make_pinhole_projection(64, 64, 0.3);
  Timeline timeline;
  timeline.overlays = {image_at("white.png", 0.0, 0.0, 10.0)};
  OverlayPass pass = pass_of(timeline, folder_.string());
  Picture picture = even_picture(screen, 0.0F);
  std::ranges::fill(picture.rgba, 0.0F);
  draw(pass, picture, screen);
  EXPECT_FLOAT_EQ(picture.rgba[4UL * (32 * 64 + 32) + 3], 1.0F);
  EXPECT_EQ(picture.rgba[3], 0.0F);
}

}  // namespace
}  // namespace ergodome
