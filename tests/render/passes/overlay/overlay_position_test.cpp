#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/core/angles.h"
#include "tests/render/passes/overlay/overlay_scene.h"
#include "tests/support/projections.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): overlays and how they are looked at

struct SurfaceDirection {
  double azimuth_deg;
  double elevation_deg;
};
constexpr SurfaceDirection surface_positions[] = {
    {0.0, 20.0}, {40.0, 35.0}, {-75.0, 10.0}, {170.0, 60.0}, {-120.0, 80.0}};

//! Returns the position of a direction in an equidistant domemaster of 180°, whose front is at the
//! bottom.
Spot spot_on_domemaster(const SurfaceDirection& at, double size_px) {
  const double radius = (90.0 - at.elevation_deg) / 90.0 * 0.5 * size_px;
  return {0.5 * size_px + radius * std::sin(one_degree * at.azimuth_deg),
          0.5 * size_px + radius * std::cos(one_degree * at.azimuth_deg)};
}

TEST_F(Overlays, StandAtTheirAzimuthAndElevationOfADome) {
  for (const SurfaceDirection& at : surface_positions) {
    expect_dot(make_dome_projection(1000, pi, 0.0), at.azimuth_deg, at.elevation_deg, spot_on_domemaster(at, 1000.0));
  }
}

TEST_F(Overlays, AreNotMovedByADomesTilt) {
  for (const SurfaceDirection& at : surface_positions) {
    expect_dot(make_dome_projection(1000, pi, 30.0 * one_degree), at.azimuth_deg, at.elevation_deg,
               spot_on_domemaster(at, 1000.0));
  }
}

TEST_F(Overlays, AreNotMovedByAViewerBesideTheMiddle) {
  DomeView view;
  view.tilt = 0.2;
  view.viewer = {0.2, -0.3, 0.4};
  for (const SurfaceDirection& at : surface_positions) {
    expect_dot(make_dome_projection(1000, view), at.azimuth_deg, at.elevation_deg, spot_on_domemaster(at, 1000.0));
  }
}

TEST_F(Overlays, AreMirroredInAPictureFromOutside) {
  const Spot inside = spot_on_domemaster(surface_positions[1], 1000.0);
  expect_dot(seen_from_outside(make_dome_projection(1000, pi, 0.0)), surface_positions[1].azimuth_deg,
             surface_positions[1].elevation_deg, {1000.0 - inside.x_px, inside.y_px});
}

TEST_F(Overlays, StandAtTheirPlacesOfAWholeSphere) {
  for (const SurfaceDirection& at :
       {SurfaceDirection{0.0, 20.0}, SurfaceDirection{100.0, -15.0}, SurfaceDirection{-40.0, 1.0}}) {
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
  // The left half of the image is white, the right half black. A clockwise rotation by a quarter
  // turn moves the left half to the top.
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 16 * 16; ++i) {
    rgb.insert(rgb.end(), 3, i % 16 < 8 ? 255 : 0);
  }
  write_png(folder_ / "half.png", rgb, 16, 16);
  Timeline timeline;
  timeline.overlays = {image_at("half.png", 0.0, 0.0, 10.0)};
  timeline.overlays[0].position.roll_deg = 90.0;
  const Spot middle = middle_of(drawn(timeline, folder_.string(), make_pinhole_projection(400, 400, 0.5)));
  EXPECT_NEAR(middle.x_px, 200.0, 0.1);
  EXPECT_LT(middle.y_px, 190.0);
}

TEST(BentSurface, StaysLevelAndKeepsItsMiddle) {
  for (const double elevation_deg : {-30.0, 0.0, 20.0, 60.0}) {
    const OverlaySurface surface = bent_surface({25.0, elevation_deg, 0.0}, 60.0 * one_degree, 5.0 * one_degree);
    for (const double s : {0.0, 0.25, 0.5, 1.0}) {
      const Vector3<double> n = direction_on_surface(surface, s, 0.5);
      EXPECT_NEAR(std::asin(n.y) / one_degree, elevation_deg, 1e-4) << s;
      EXPECT_NEAR(std::atan2(n.x, -n.z) / one_degree, 25.0 + (s - 0.5) * 60.0 / std::cos(one_degree * elevation_deg),
                  1e-4);
    }
  }
}

TEST(BentSurface, KeepsTheShapeOfLetters) {
  for (const double elevation_deg : {0.0, 30.0, 60.0, 75.0, 90.0}) {
    const OverlaySurface surface = bent_surface({0.0, elevation_deg, 10.0}, 60.0 * one_degree, 10.0 * one_degree);
    for (const double s : {0.1, 0.5, 0.9}) {
      for (const double t : {0.1, 0.5, 0.9}) {
        const Vector3<double> n = direction_on_surface(surface, s, t);
        const Vector3<double> right = 1e4 * (direction_on_surface(surface, s + 1e-4 / (60.0 * one_degree), t) - n);
        const Vector3<double> down = 1e4 * (direction_on_surface(surface, s, t + 1e-4 / (10.0 * one_degree)) - n);
        EXPECT_NEAR(dot(right, down), 0.0, 2e-3);
        EXPECT_NEAR(dot(right, right), dot(down, down), 2e-3);
        if (t == 0.5) {
          EXPECT_NEAR(dot(right, right), 1.0, 2e-3) << elevation_deg;
        }
      }
    }
  }
}

TEST(OverlaySurfaces, GiveDirectionsBackTheirPlaces) {
  const OverlaySurface surfaces[] = {bent_surface({20.0, 40.0, 15.0}, 1.0, 0.2),
                                     flat_surface({-50.0, 70.0, 200.0}, 0.8, 1.5)};
  for (const OverlaySurface& surface : surfaces) {
    for (const double s : {0.0, 0.3, 1.0}) {
      for (const double t : {0.0, 0.6, 1.0}) {
        const Vector3<double> n = direction_on_surface(surface, s, t);
        const auto plain = [](double x) { return Dual<float>(static_cast<float>(x)); };
        Dual<float> s_back;
        Dual<float> t_back;
        project_to_surface<float>(surface, {plain(n.x), plain(n.y), plain(n.z)}, s_back, t_back);
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
      OverlaySurface surface = flat_surface({360.0 * part(random), 180.0 * part(random) - 90.0, 0.0}, 0.05, 1.0);
      bound_surface(surface, 0.01);
      const std::vector<std::int32_t> within = tiles.within(surface);
      for (int k = 0; k < 10; ++k) {
        double x = 0.0;
        double y = 0.0;
        const Vector3<double> n = direction_on_surface(surface, part(random), part(random));
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
  OverlaySurface surface = flat_surface({0.0, 30.0, 0.0}, 10.0 * one_degree, 1.0);
  bound_surface(surface, 0.002);
  // The overlay is a square of 10 degrees, which is 114 px wide; it must not need more tiles than
  // that.
  EXPECT_LT(tiles.within(surface).size(), 64U);
  EXPECT_GT(tiles.within(surface).size(), 12U);
}

}  // namespace
}  // namespace ergodome
