#include "render/passes/stars/drawing/tiled_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/stars/drawing/picture_regions.h"
#include "tests/support/tiny_sky.h"

// The program can draw stars by gathering them for each pixel. The picture must be the same as by
// splatting each star into its pixels.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): skies of tests

//! Returns random points in and around a picture, sorted by row from the top. Every tenth point has
//! spikes.
std::vector<StarPoint> scattered(const Projection& projection, int count) {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const std::vector<PictureRegion> regions = picture_regions(projection);
  const double beside_px = wraps_around(projection) ? 0.0 : 9.0;
  std::vector<StarPoint> points;
  for (int i = 0; i < count; ++i) {
    const auto region = static_cast<std::size_t>(i) % regions.size();
    const PixelCell& cell = regions[region].cell;
    StarPoint point{};
    point.x_px = cell.left_px + number(-beside_px, cell.width_px + beside_px);
    point.y_px = cell.top_px + number(-9.0, cell.height_px + 9.0);
    point.light = {static_cast<float>(number(0.0, 4.0)), 1.0F, static_cast<float>(number(0.0, 2.0))};
    point.spikes = i % 10 == 0 ? 0.5F * point.light : Vector3<float>{};
    point.region = static_cast<int>(region);
    points.push_back(point);
  }
  std::ranges::stable_sort(points, {}, [](const StarPoint& point) { return std::floor(point.y_px); });
  return points;
}

std::vector<float> tiled(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& splat,
                         const DiffractionPattern* pattern, int rows_at_once) {
  const auto width = static_cast<std::size_t>(projection.width_px);
  std::vector<float> rgba(4 * width * static_cast<std::size_t>(projection.height_px), 0.25F);
  TiledStars stars(Backend::cpu);
  stars.set(points, projection, splat, pattern);
  for (int row = 0; row < projection.height_px; row += rows_at_once) {
    stars.draw(row, std::min(rows_at_once, projection.height_px - row),
               rgba.data() + 4 * width * static_cast<std::size_t>(row));
  }
  return rgba;
}

void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
  float brightest = 0.0F;
  float farthest = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) {
    brightest = std::max(brightest, b[i]);
    farthest = std::max(farthest, std::abs(a[i] - b[i]));
  }
  ASSERT_GT(brightest, 0.5F);
  EXPECT_LT(farthest, 3e-6F * brightest);
}

std::vector<Projection> projections() {
  return {make_dome_projection(203, pi, 0.4), make_equirectangular_projection(210, 105),
          make_pinhole_projection(190, 121, 1.0), make_cube_projection(60, CubeLayout::cross)};
}

TEST(TiledStars, MakeThePictureOfPointsThatSeekTheirPixels) {
  for (const Projection& projection : projections()) {
    const std::vector<StarPoint> points = scattered(projection, 3000);
    for (const double sigma_px : {0.0, 0.4, 3.0}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(projection.kind) << " " << sigma_px);
      const SplatSettings splat{sigma_px, 1.0F};
      std::vector<float> expected(
          4 * static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(projection.height_px), 0.25F);
      splat_points(points, projection, splat, 0, projection.height_px, expected.data());
      expect_same(tiled(points, projection, splat, nullptr, projection.height_px), expected);
      expect_same(tiled(points, projection, splat, nullptr, 37), expected);
    }
  }
}

TEST(TiledStars, HaveSpikesWherePointsHaveThem) {
  DiffractionPattern pattern;
  pattern.size_px = 23;
  for (int i = 0; i < 3 * 23 * 23; ++i) {
    pattern.rgb.push_back(static_cast<float>(i % 97) / 97.0F);
  }
  for (const Projection& projection : projections()) {
    SCOPED_TRACE(static_cast<int>(projection.kind));
    const std::vector<StarPoint> points = scattered(projection, 200);
    const int width = projection.width_px;
    const int height = projection.height_px;
    SplatSettings splat{0.4, 1.0F};
    splat.spike_reach_px = 12.5;
    std::vector<float> expected(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.25F);
    splat_points(points, projection, splat, 0, height, expected.data());
    const std::vector<PictureRegion> regions = picture_regions(projection);
    for (const StarPoint& point : points) {
      const PixelCell& cell = regions[static_cast<std::size_t>(point.region)].cell;
      const PixelBlock block = {width, cell.height_px, cell.left_px, cell.left_px + cell.width_px,
                                expected.data() + 4L * cell.top_px * width};
      for (int turn = wraps_around(projection) ? -1 : 0; turn <= (wraps_around(projection) ? 1 : 0); ++turn) {
        add_diffraction(pattern, point.x_px + turn * width, point.y_px - cell.top_px, point.spikes, block);
      }
    }
    // Spikes do not extend beyond the edge of the projection's image.
    for (int i = 0; i < width * height; ++i) {
      const int row = i / width;
      if (!(image_coverage(projection, i % width + 0.5, row + 0.5) > 0.0)) {
        std::fill_n(expected.begin() + 4L * i, 3, 0.25F);
      }
    }
    expect_same(tiled(points, projection, splat, &pattern, height), expected);
  }
}

TEST(TiledStars, ComeAndGo) {
  const Projection projection = make_dome_projection(128, pi, 0.0);
  TiledStars stars(Backend::cpu);
  std::vector<float> rgba(4UL * 128 * 128);
  stars.set(scattered(projection, 500), projection, {0.4, 1.0F}, nullptr);
  stars.set(std::vector<StarPoint>(), projection, {0.4, 1.0F}, nullptr);
  stars.draw(0, 128, rgba.data());
  EXPECT_EQ(*std::ranges::max_element(rgba), 0.0F);
}

TEST(TiledStars, AreThoseOfAPictureThatStaysWhereItIsMade) {
  Show show = parse_show(
      "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 12\ntheta_deg = 70\n[sky]\nstars = \"bright_stars\"\n"
      "[effects]\nmagnification = true\npsf = { sigma_px = 0.6 }\ndiffraction = { brighter_than_mag = 3 }\n"
      "[view]\nprojection = \"equirect\"\nsize_px = 300\n",
      "stars.toml");
  show.sky.map = tiny_sky();
  ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
  const CameraPose pose = camera_pose(show, 0.0);
  const Projection projection = make_projection(show.view, 300, 0.0);
  const Picture expected = renderer.render_eye(pose, 0.0, projection, ViewMode::sky);
  const float* const made = renderer.render_eye_in_place(pose, 0.0, projection, ViewMode::sky, {}).rgba;
  expect_same({made, made + expected.rgba.size()}, {expected.rgba.begin(), expected.rgba.end()});
}

TEST(BackendEyes, AreThoseOfAWindow) {
  for (const bool swapped : {false, true}) {
    Show show = parse_show(
        "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 12\ntheta_deg = 70\n[sky]\nstars = \"bright_stars\"\n"
        "[view]\nprojection = \"pinhole\"\nsize_px = 200\n[stereo]\nlayout = \"side_by_side\"\nbaseline = 0.5\n",
        "eyes.toml");
    show.sky.map = tiny_sky();
    show.stereo.swap_eyes = swapped;
    ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
    const CameraPose pose = camera_pose(show, 0.0);
    const Projection projection = make_projection(show.view, 200, 0.0);
    const std::vector<Picture> expected = renderer.render_window_parts(pose, projection, ViewMode::sky);
    const BackendEyes made = renderer.render_eyes_in_place(pose, projection, ViewMode::sky, {});
    ASSERT_EQ(expected.size(), 2U);
    EXPECT_FALSE(std::ranges::equal(expected[0].rgba, expected[1].rgba));
    const auto expect_eye = [](const BackendPicture& there, const Picture& here) {
      expect_same({there.rgba, there.rgba + here.rgba.size()}, {here.rgba.begin(), here.rgba.end()});
      EXPECT_STREQ(there.lens, here.lens);
    };
    expect_eye(made.first, expected[0]);
    ASSERT_TRUE(made.right.has_value());
    expect_eye(*made.right, expected[1]);
  }
}

}  // namespace
}  // namespace ergodome
