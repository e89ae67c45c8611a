#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/work_counter.h"
#include "render/frame/view_projection.h"
#include "render/output/image_writer.h"
#include "render/output/tone_map.h"
#include "render/overlay/overlay_pass.h"
#include "render/overlay/overlay_place.h"
#include "render/patterns/test_pattern.h"
#include "tests/support/folder_test.h"
#include "tests/support/projections.h"

namespace ergodome {
namespace {

constexpr Tone as_it_is = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
constexpr Presence always = {-1e9, 1e9, 0.0, 0.0};

Picture even_picture(const Projection& projection, float light, const Tone& tone = as_it_is) {
  Picture picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  picture.tone = tone;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto covered = static_cast<float>(image_coverage(projection, x + 0.5, y + 0.5));
      picture.rgba.insert(picture.rgba.end(), {covered * light, covered * light, covered * light, covered});
    }
  }
  return picture;
}

//! Draws what is there at a time on a picture.
void draw(OverlayPass& pass, Picture& picture, const Projection& projection, double time_s = 0.0) {
  pass.draw({Backend::cpu, picture.rgba.data(), picture.tone, picture.heat_range.has_value()},
            overlay_projection(projection), time_s);
}

Picture drawn(const Timeline& timeline, const std::string& folder, const Projection& projection, float light = 0.0F,
              double time_s = 0.0) {
  OverlayPass pass(timeline, folder);
  Picture picture = even_picture(projection, light);
  draw(pass, picture, projection, time_s);
  return picture;
}

Caption caption_of(const std::string& text, double azimuth_deg = 0.0, double elevation_deg = 20.0) {
  Caption caption;
  caption.presence = always;
  caption.place = {azimuth_deg, elevation_deg, 0.0};
  caption.letter_deg = 5.0;
  caption.text[""] = text;
  return caption;
}

Timeline captions_of(std::vector<Caption> captions) {
  Timeline timeline;
  timeline.captions = std::move(captions);
  return timeline;
}

double sum_of_light(const Picture& picture) {
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    sum += static_cast<double>(picture.rgba[i]);
  }
  return sum;
}

struct Spot {
  double x_px;
  double y_px;
};

//! The middle of a picture's light.
Spot middle_of(const Picture& picture) {
  double sum = 0.0;
  Spot middle{0.0, 0.0};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto light =
          static_cast<double>(picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                                static_cast<std::size_t>(x))]);
      sum += light;
      middle.x_px += light * (x + 0.5);
      middle.y_px += light * (y + 0.5);
    }
  }
  return {middle.x_px / sum, middle.y_px / sum};
}

class Overlays : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write_png(folder_ / "white.png", std::vector<std::uint8_t>(3UL * 16 * 16, 255), 16, 16);
    write_png(folder_ / "grey.png", std::vector<std::uint8_t>(3UL * 16 * 16, 128), 16, 16);
  }

  [[nodiscard]] static Overlay image_at(const std::string& file, double azimuth_deg, double elevation_deg,
                                        double width_deg) {
    Overlay overlay;
    overlay.image = file;
    overlay.presence = always;
    overlay.place = {azimuth_deg, elevation_deg, 0.0};
    overlay.width_deg = width_deg;
    return overlay;
  }

  [[nodiscard]] Picture spot_of(const Projection& projection, double azimuth_deg, double elevation_deg) const {
    Timeline timeline;
    timeline.overlays = {image_at("white.png", azimuth_deg, elevation_deg, 1.0)};
    return drawn(timeline, folder_.string(), projection);
  }

  void expect_dot(const Projection& projection, double azimuth_deg, double elevation_deg, const Spot& expected) const {
    const Picture picture = spot_of(projection, azimuth_deg, elevation_deg);
    ASSERT_GT(sum_of_light(picture), 1.0);
    const Spot middle = middle_of(picture);
    EXPECT_NEAR(middle.x_px, expected.x_px, 0.05) << azimuth_deg << " " << elevation_deg;
    EXPECT_NEAR(middle.y_px, expected.y_px, 0.05) << azimuth_deg << " " << elevation_deg;
  }
};

struct SheetDirection {
  double azimuth_deg;
  double elevation_deg;
};
constexpr SheetDirection sheet_places[] = {{0.0, 20.0}, {40.0, 35.0}, {-75.0, 10.0}, {170.0, 60.0}, {-120.0, 80.0}};

//! An equidistant domemaster of 180°, front at the bottom.
Spot spot_on_domemaster(const SheetDirection& at, double size_px) {
  const double radius = (90.0 - at.elevation_deg) / 90.0 * 0.5 * size_px;
  return {0.5 * size_px + radius * std::sin(one_degree * at.azimuth_deg),
          0.5 * size_px + radius * std::cos(one_degree * at.azimuth_deg)};
}

TEST_F(Overlays, StandAtTheirAzimuthAndElevationOfADome) {
  for (const SheetDirection& at : sheet_places) {
    expect_dot(make_dome_projection(1000, pi, 0.0), at.azimuth_deg, at.elevation_deg, spot_on_domemaster(at, 1000.0));
  }
}

TEST_F(Overlays, AreNotMovedByADomesTilt) {
  for (const SheetDirection& at : sheet_places) {
    expect_dot(make_dome_projection(1000, pi, 30.0 * one_degree), at.azimuth_deg, at.elevation_deg,
               spot_on_domemaster(at, 1000.0));
  }
}

TEST_F(Overlays, AreNotMovedByAViewerBesideTheMiddle) {
  DomeView view;
  view.tilt = 0.2;
  view.viewer = {0.2, -0.3, 0.4};
  for (const SheetDirection& at : sheet_places) {
    expect_dot(make_dome_projection(1000, view), at.azimuth_deg, at.elevation_deg, spot_on_domemaster(at, 1000.0));
  }
}

TEST_F(Overlays, AreMirroredInAPictureFromOutside) {
  const Spot inside = spot_on_domemaster(sheet_places[1], 1000.0);
  expect_dot(seen_from_outside(make_dome_projection(1000, pi, 0.0)), sheet_places[1].azimuth_deg,
             sheet_places[1].elevation_deg, {1000.0 - inside.x_px, inside.y_px});
}

TEST_F(Overlays, StandAtTheirPlacesOfAWholeSphere) {
  for (const SheetDirection& at :
       {SheetDirection{0.0, 20.0}, SheetDirection{100.0, -15.0}, SheetDirection{-40.0, 1.0}}) {
    expect_dot(make_equirectangular_projection(1800, 900), at.azimuth_deg, at.elevation_deg,
               {900.0 + 5.0 * at.azimuth_deg, 450.0 - 5.0 * at.elevation_deg});
  }
}

TEST_F(Overlays, CrossTheSeamOfAWholeSphere) {
  const Picture picture = spot_of(make_equirectangular_projection(1800, 900), 180.0, 0.0);
  const std::size_t row = 4UL * 1800 * 450;
  EXPECT_GT(picture.rgba[row], 0.9F);
  EXPECT_GT(picture.rgba[row + 4 * 1799], 0.9F);
}

TEST_F(Overlays, StandAtTheirPlacesOfACube) {
  const Projection front = make_cube_face_projection(800, CubeFace::front);
  const double up = std::tan(20.0 * one_degree) / std::cos(25.0 * one_degree);
  expect_dot(front, 25.0, 20.0, {400.0 + 400.0 * std::tan(25.0 * one_degree), 400.0 - 400.0 * up});
}

TEST_F(Overlays, StandAtTheirPlacesOfAScreen) {
  const Projection screen = make_pinhole_projection(900, 600, 60.0 * one_degree);
  const double px = 450.0 / std::tan(30.0 * one_degree);
  expect_dot(screen, -12.0, 9.0,
             {450.0 - px * std::tan(12.0 * one_degree),
              300.0 - px * std::tan(9.0 * one_degree) / std::cos(12.0 * one_degree)});
}

TEST_F(Overlays, OfADomeStayOnASmallScreen) {
  const Projection screen = make_pinhole_projection(480, 270, 50.0 * one_degree);
  const Picture picture = drawn(captions_of({caption_of("A long line for a wide dome", 0.0, 45.0)}), "", screen);
  EXPECT_GT(sum_of_light(picture), 100.0);
  for (int x = 0; x < 480; ++x) {
    for (const int y : {0, 1, 268, 269}) {
      EXPECT_EQ(picture.rgba[4UL * static_cast<std::size_t>(480 * y + x)], 0.0F) << x << " " << y;
    }
  }
}

TEST_F(Overlays, ForThoseWhoLookElsewhereAreNotOnAScreen) {
  const Projection screen = make_pinhole_projection(480, 270, 50.0 * one_degree);
  EXPECT_EQ(sum_of_light(drawn(captions_of({caption_of("Behind", 180.0)}), "", screen)), 0.0);
}

TEST_F(Overlays, RollClockwise) {
  // Left half white, right half black: turned by a quarter, the left comes to the top.
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 16 * 16; ++i) {
    rgb.insert(rgb.end(), 3, i % 16 < 8 ? 255 : 0);
  }
  write_png(folder_ / "half.png", rgb, 16, 16);
  Timeline timeline;
  timeline.overlays = {image_at("half.png", 0.0, 0.0, 10.0)};
  timeline.overlays[0].place.roll_deg = 90.0;
  const Spot middle = middle_of(drawn(timeline, folder_.string(), make_pinhole_projection(400, 400, 0.5)));
  EXPECT_NEAR(middle.x_px, 200.0, 0.1);
  EXPECT_LT(middle.y_px, 190.0);
}

TEST(BentSheet, StaysLevelAndKeepsItsMiddle) {
  for (const double elevation_deg : {-30.0, 0.0, 20.0, 60.0}) {
    const OverlaySheet sheet = bent_sheet({25.0, elevation_deg, 0.0}, 60.0 * one_degree, 5.0 * one_degree);
    for (const double s : {0.0, 0.25, 0.5, 1.0}) {
      const Vector3<double> n = direction_on_sheet(sheet, s, 0.5);
      EXPECT_NEAR(std::asin(n.y) / one_degree, elevation_deg, 1e-4) << s;
      EXPECT_NEAR(std::atan2(n.x, -n.z) / one_degree, 25.0 + (s - 0.5) * 60.0 / std::cos(one_degree * elevation_deg),
                  1e-4);
    }
  }
}

TEST(BentSheet, KeepsTheShapeOfLetters) {
  for (const double elevation_deg : {0.0, 30.0, 60.0, 75.0, 90.0}) {
    const OverlaySheet sheet = bent_sheet({0.0, elevation_deg, 10.0}, 60.0 * one_degree, 10.0 * one_degree);
    for (const double s : {0.1, 0.5, 0.9}) {
      for (const double t : {0.1, 0.5, 0.9}) {
        const Vector3<double> n = direction_on_sheet(sheet, s, t);
        const Vector3<double> right = 1e4 * (direction_on_sheet(sheet, s + 1e-4 / (60.0 * one_degree), t) - n);
        const Vector3<double> down = 1e4 * (direction_on_sheet(sheet, s, t + 1e-4 / (10.0 * one_degree)) - n);
        EXPECT_NEAR(dot(right, down), 0.0, 2e-3);
        EXPECT_NEAR(dot(right, right), dot(down, down), 2e-3);
        if (t == 0.5) {
          EXPECT_NEAR(dot(right, right), 1.0, 2e-3) << elevation_deg;
        }
      }
    }
  }
}

TEST(OverlaySheets, GiveDirectionsBackTheirPlaces) {
  const OverlaySheet sheets[] = {bent_sheet({20.0, 40.0, 15.0}, 1.0, 0.2), flat_sheet({-50.0, 70.0, 200.0}, 0.8, 1.5)};
  for (const OverlaySheet& sheet : sheets) {
    for (const double s : {0.0, 0.3, 1.0}) {
      for (const double t : {0.0, 0.6, 1.0}) {
        const Vector3<double> n = direction_on_sheet(sheet, s, t);
        const auto plain = [](double x) { return Dual<float>(static_cast<float>(x)); };
        Dual<float> s_back;
        Dual<float> t_back;
        place_on_sheet<float>(sheet, {plain(n.x), plain(n.y), plain(n.z)}, s_back, t_back);
        EXPECT_NEAR(s_back.value, s, 2e-6);
        EXPECT_NEAR(t_back.value, t, 5e-6);
      }
    }
  }
}

TEST(PictureTiles, OfEveryProjectionHoldWhatASheetsBoundHolds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const test::NamedProjection& named : test::every_projection()) {
    const Projection& projection = named.projection;
    const PictureTiles tiles(projection);
    for (int i = 0; i < 40; ++i) {
      OverlaySheet sheet = flat_sheet({360.0 * part(random), 180.0 * part(random) - 90.0, 0.0}, 0.05, 1.0);
      bound_sheet(sheet, 0.01);
      const std::vector<std::int32_t> within = tiles.within(sheet);
      for (int k = 0; k < 10; ++k) {
        double x = 0.0;
        double y = 0.0;
        const Vector3<double> n = direction_on_sheet(sheet, part(random), part(random));
        if (pixel_from_direction(projection, n, x, y) && test::is_in_image(projection, {x, y})) {
          const int tile =
              static_cast<int>(y) / overlay_tile_px * tiles.columns() + static_cast<int>(x) / overlay_tile_px;
          EXPECT_THAT(within, testing::Contains(tile)) << named.name << " " << x << " " << y;
        }
      }
    }
  }
}

TEST(PictureTiles, OfASmallOverlayAreFew) {
  const PictureTiles tiles(make_dome_projection(2048, pi, 0.0));
  OverlaySheet sheet = flat_sheet({0.0, 30.0, 0.0}, 10.0 * one_degree, 1.0);
  bound_sheet(sheet, 0.002);
  // A square of 10 degrees is 114 px wide.
  EXPECT_LT(tiles.within(sheet).size(), 64U);
  EXPECT_GT(tiles.within(sheet).size(), 12U);
}

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

//! The byte shown in the middle of an overlay that fills a screen.
int shown_in_the_middle(const Timeline& timeline, const std::string& folder, float light, const Tone& tone,
                        double time_s = 0.0) {
  const Projection screen = make_pinhole_projection(64, 64, 0.3);
  OverlayPass pass(timeline, folder);
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
  // Half of white over a fifth, then a quarter, in light; sRGB by hand.
  EXPECT_NEAR(shown_in_the_middle(timeline, folder_.string(), 0.2F, as_it_is, 5.0), 203, 1);
  EXPECT_NEAR(shown_in_the_middle(timeline, folder_.string(), 0.2F, as_it_is, 1.0), 170, 1);
}

TEST_F(Overlays, OnAHeatMapKeepTheirColours) {
  const Projection screen = make_pinhole_projection(64, 64, 0.3);
  Timeline timeline;
  timeline.overlays = {image_at("grey.png", 0.0, 0.0, 10.0)};
  OverlayPass pass(timeline, folder_.string());
  Picture picture = even_picture(screen, 0.7F, {ToneCurve::reinhard, 3.0F});
  picture.heat_range = HeatRange{0.0, 1.0, false};
  draw(pass, picture, screen);
  EXPECT_NEAR(tone_mapped(picture)[3UL * (32 * 64 + 32)], 128, 1);
}

TEST_F(Overlays, HaveNoDarkFringes) {
  // A white disc with a soft rim; what is transparent is black in the file.
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
  // Its circle has half the dome's radius; half a pixel is added.
  EXPECT_NEAR(covered, pi * 100.5 * 100.5, 0.01 * covered);
}

TEST_F(Overlays, GiveTheirAlphaToThePicture) {
  const Projection screen = make_pinhole_projection(64, 64, 0.3);
  Timeline timeline;
  timeline.overlays = {image_at("white.png", 0.0, 0.0, 10.0)};
  OverlayPass pass(timeline, folder_.string());
  Picture picture = even_picture(screen, 0.0F);
  std::ranges::fill(picture.rgba, 0.0F);
  draw(pass, picture, screen);
  EXPECT_FLOAT_EQ(picture.rgba[4UL * (32 * 64 + 32) + 3], 1.0F);
  EXPECT_EQ(picture.rgba[3], 0.0F);
}

TEST_F(Overlays, StandOnTheScreenForBothEyesOrBehindIt) {
  const Projection head = make_pinhole_projection(400, 200, 60.0 * one_degree);
  const double px = 200.0 / std::tan(30.0 * one_degree);
  Timeline timeline;
  timeline.overlays = {image_at("white.png", 0.0, 0.0, 2.0)};
  OverlayPass pass(timeline, folder_.string());
  const auto place = [&](double offset, double convergence, double distance) {
    Picture picture = even_picture(head, 0.0F);
    pass.draw({Backend::cpu, picture.rgba.data(), picture.tone, false},
              overlay_projection(head, offset, convergence, distance), 0.0);
    return middle_of(picture).x_px;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // An eye to the right sees what is behind the screen's distance to the right of where it is on the screen.
  EXPECT_NEAR(place(0.1, 5.0, 0.0), 200.0, 0.05);
  EXPECT_NEAR(place(0.1, 5.0, 5.0), 200.0, 0.05);
  EXPECT_NEAR(place(0.1, 5.0, infinity), 200.0 + 0.1 / 5.0 * px, 0.05);
  EXPECT_NEAR(place(0.1, 5.0, 2.5), 200.0 - 0.1 / 5.0 * px, 0.05);
  EXPECT_NEAR(place(0.1, 0.0, infinity), 200.0, 0.05);
}

TEST_F(Overlays, BehindTheDomeAreWhereThePictureHasTheSky) {
  const Projection head = make_dome_projection(800, pi, 0.0);
  const Projection eye = converged_projection(head, 0.3, 6.0);
  const Projection behind = overlay_projection(head, 0.3, 6.0, std::numeric_limits<double>::infinity());
  for (const double x : {200.0, 410.0, 600.0}) {
    const Vector3<double> a = direction_from_pixel(eye, x, 350.0);
    const Vector3<double> b = direction_from_pixel(behind, x, 350.0);
    EXPECT_NEAR(dot(a, b), 1.0, 1e-12);
  }
}

TEST_F(Overlays, AreSetInTheLanguageThatIsChosen) {
  Caption caption = caption_of("");
  caption.text = {{"en", "A"}, {"de", "Ein sehr viel längerer Text"}};
  OverlayPass pass(captions_of({caption}), "");
  const Projection projection = make_dome_projection(300, pi, 0.0);
  const auto light = [&](const std::string& language) {
    pass.set_language(language);
    Picture picture = even_picture(projection, 0.0F);
    draw(pass, picture, projection);
    return sum_of_light(picture);
  };
  EXPECT_GT(light("de"), 5.0 * light("en"));
}

TEST_F(Overlays, HideTheShowsCaptionsAndNotItsImages) {
  Timeline timeline = captions_of({caption_of("Here")});
  OverlayPass words(timeline, "");
  words.set_captions(false);
  EXPECT_FALSE(words.draws_at(0.0));
  timeline.overlays = {image_at("white.png", 0.0, 20.0, 5.0)};
  OverlayPass both(timeline, folder_.string());
  both.set_captions(false);
  EXPECT_TRUE(both.draws_at(0.0));
}

TEST_F(Overlays, OfOthersAreThereWithoutAShow) {
  OverlayPass pass({}, "");
  const Projection projection = make_dome_projection(300, pi, 0.0);
  EXPECT_FALSE(pass.draws_at(std::nullopt));
  Caption welcome = caption_of("Welcome");
  welcome.presence = {};
  pass.set_extra({welcome});
  ASSERT_TRUE(pass.draws_at(std::nullopt));
  Picture picture = even_picture(projection, 0.0F);
  pass.draw({Backend::cpu, picture.rgba.data(), picture.tone, false}, projection, std::nullopt);
  EXPECT_GT(sum_of_light(picture), 50.0);
  pass.set_extra({});
  EXPECT_FALSE(pass.draws_at(std::nullopt));
}

TEST_F(Overlays, ThatAreNotThereTakeNothing) {
  Timeline timeline = captions_of({caption_of("Later")});
  timeline.captions[0].presence = {5.0, 8.0, 0.5, 0.5};
  OverlayPass pass(timeline, "");
  const Projection projection = make_dome_projection(300, pi, 0.0);
  Picture picture = even_picture(projection, 0.0F);
  const auto before = work_done();
  draw(pass, picture, projection, 4.0);
  EXPECT_TRUE(work_between(before, work_done()).empty());
}

TEST_F(Overlays, AreSetOnceAndTouchTheirOwnTilesAlone) {
  OverlayPass pass(captions_of({caption_of("Once")}), "");
  const Projection projection = make_dome_projection(1024, pi, 0.0);
  Picture picture = even_picture(projection, 0.0F);
  draw(pass, picture, projection);
  const auto before = work_done();
  draw(pass, picture, projection);
  const auto work = work_between(before, work_done());
  ASSERT_EQ(work.size(), 1U);
  EXPECT_EQ(work.at("draw_overlay").runs, 1);
  EXPECT_LT(work.at("draw_overlay").elements, 1024L * 1024 / 20);
}

TEST_F(Overlays, ThatCannotBeReadAreErrors) {
  const auto problem = [&](const Overlay& overlay) {
    Timeline timeline;
    timeline.overlays = {overlay};
    try {
      const OverlayPass pass(timeline, folder_.string());
    } catch (const Error& error) {
      EXPECT_FALSE(error.remedy().empty());
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(problem(image_at("missing.png", 0.0, 0.0, 10.0)), testing::HasSubstr("missing.png"));
  EXPECT_THAT(problem(image_at("white.png", 0.0, 0.0, 170.0)), testing::HasSubstr("170 degrees"));
  write_png(folder_ / "wide.png", std::vector<std::uint8_t>(3UL * 16 * 8, 255), 16, 8);
  Overlay wide = image_at("wide.png", 0.0, 0.0, 10.0);
  wide.fisheye = true;
  EXPECT_THAT(problem(wide), testing::HasSubstr("square"));
  write_png(folder_ / "long.png", std::vector<std::uint8_t>(3UL * 8200 * 2, 255), 8200, 2);
  EXPECT_THAT(problem(image_at("long.png", 0.0, 0.0, 10.0)), testing::HasSubstr("8192"));
}

}  // namespace
}  // namespace ergodome
