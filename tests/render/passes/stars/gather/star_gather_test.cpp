#include "render/passes/stars/gather/star_gather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "tests/render/lens_about.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Images are compared only if the relative change of the magnification across their pixel is at
//! most this, because gathered stars have the mean magnification of their pixel. Measured: the
//! light of such images differs by at most 0.9 %.
constexpr double max_change = 0.01;
//! Minimum distance from the shadow's edge of images that are compared [px]. Closer to the edge,
//! the sky winds around the hole, and the corners of a pixel do not represent its inside.
constexpr double min_edge_px = 20.0;
//! Minimum distance from other images of the same star, for images that are compared [px].
constexpr double min_apart_px = 5.0;

ScreenPosition position_of(const GatheredStar& star) {
  return {star.x_px + static_cast<double>(star.x_inside), star.y_px + static_cast<double>(star.y_inside)};
}

double distance(const ScreenPosition& a, const ScreenPosition& b) {
  return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
}

double luminance(const Vector3<float>& light) {
  return static_cast<double>(0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z);
}

constexpr int gather_size_px = 1024;

//! Returns a dome projection in which the hole is 30 degrees from the middle.
Projection gather_dome() { return make_dome_projection(gather_size_px, pi, pi / 3); }

bool is_well_inside(const ScreenPosition& p) { return std::hypot(p.x_px - 512.0, p.y_px - 512.0) < 510.0; }

using PositionsByStar = std::multimap<int, ScreenPosition>;

//! The star images that both search methods find for a camera, and their positions on the screen.
struct BothSearches {
  EyeCamera eye;
  StarField field;
  StarSettings settings;
  std::vector<StarImage> inverted;
  std::vector<ScreenPosition> inverted_positions;
  GatheredStars gathered;
  std::vector<ScreenPosition> gathered_positions;

  explicit BothSearches(const CameraState& position)
      : eye(eye_at_position(position)),
        field(brightest(12000), glm::dmat3(1.0), colours().view()),
        settings(settings_for(14.0)) {
    settings.pixel = pixel_angle(gather_dome());
    settings.redshift = true;
    inverted = images_of(field, eye, settings);
    for (const StarImage& image : inverted) {
      inverted_positions.push_back(on_screen(eye, gather_dome(), image.direction));
    }
    gathered = gather_stars(field, StarTree(field), colours().view(), eye, gather_dome(), settings);
    for (const GatheredStar& star : gathered.stars) {
      gathered_positions.push_back(position_of(star));
    }
  }
};

//! Returns how many images of a star are closer to a position than `limit_px`.
std::ptrdiff_t count_near(const PositionsByStar& positions, int star, const ScreenPosition& position, double limit_px) {
  const auto [first, last] = positions.equal_range(star);
  return std::count_if(first, last, [&](const auto& other) { return distance(other.second, position) < limit_px; });
}

class StarsGatheredByPixels : public testing::TestWithParam<CameraState> {
 protected:
  void SetUp() override {
    if (test::sanitized) {
      GTEST_SKIP() << "many rays";
    }
  }
};

TEST_P(StarsGatheredByPixels, ShineLikeInvertedImages) {
  const BothSearches both(GetParam());
  const std::vector<double> changes = LensAbout(both.eye, gather_dome(), min_edge_px).changes(both.inverted_positions);
  std::multimap<int, const GatheredStar*> by_star;
  for (const GatheredStar& star : both.gathered.stars) {
    by_star.emplace(star.star, &star);
  }
  PositionsByStar positions;
  for (std::size_t i = 0; i < both.inverted.size(); ++i) {
    positions.emplace(both.inverted[i].star, both.inverted_positions[i]);
  }
  std::vector<double> errors;
  for (std::size_t i = 0; i < both.inverted.size(); ++i) {
    const StarImage& image = both.inverted[i];
    const ScreenPosition& position = both.inverted_positions[i];
    if (!is_well_inside(position) || changes[i] > max_change ||
        luminance(image.illuminance) < 1.02 * static_cast<double>(both.settings.faintest) ||
        count_near(positions, image.star, position, min_apart_px) > 1) {
      continue;
    }
    const auto [first, last] = by_star.equal_range(image.star);
    const auto match = std::find_if(
        first, last, [&](const auto& star) { return distance(position_of(*star.second), position) < 0.5; });
    ASSERT_NE(match, last) << "no gathered star at " << position.x_px << ", " << position.y_px;
    EXPECT_GT(match->second->magnification * image.magnification, 0.0F);
    EXPECT_NEAR(match->second->frequency_ratio / image.frequency_ratio, 1.0F, 2e-3F);
    errors.push_back(std::abs(luminance(match->second->illuminance) / luminance(image.illuminance) - 1.0));
  }
  ASSERT_GT(errors.size(), 500U);
  std::ranges::sort(errors);
  EXPECT_LT(errors[errors.size() / 2], 1e-3);
  EXPECT_LT(errors[errors.size() * 9 / 10], 3e-3);
  EXPECT_LT(errors.back(), 0.01);
}

TEST_P(StarsGatheredByPixels, AreNotSeenWhereThereIsNoImage) {
  const BothSearches both(GetParam());
  const std::vector<double> changes = LensAbout(both.eye, gather_dome(), min_edge_px).changes(both.gathered_positions);
  PositionsByStar positions;
  for (std::size_t i = 0; i < both.inverted.size(); ++i) {
    positions.emplace(both.inverted[i].star, both.inverted_positions[i]);
  }
  std::size_t compared = 0;
  for (std::size_t i = 0; i < both.gathered.stars.size(); ++i) {
    const GatheredStar& star = both.gathered.stars[i];
    const ScreenPosition& position = both.gathered_positions[i];
    if (is_well_inside(position) && changes[i] <= max_change &&
        luminance(star.illuminance) > 1.02 * static_cast<double>(both.settings.faintest)) {
      EXPECT_EQ(count_near(positions, star.star, position, 0.5), 1) << position.x_px << ", " << position.y_px;
      ++compared;
    }
  }
  EXPECT_GT(compared, 500U);
  EXPECT_GT(both.gathered.shadowed_pixels, 0);
  EXPECT_GT(both.gathered.stretched_pixels, 0);
}

INSTANTIATE_TEST_SUITE_P(Cameras, StarsGatheredByPixels, testing::ValuesIn(positions));

//! Returns a catalogue of stars whose images are at the given positions on the screen, by exact
//! rays.
StarCatalogue stars_at(const EyeCamera& eye, const Projection& projection,
                       const std::vector<ScreenPosition>& positions) {
  StarCatalogue catalogue;
  const CameraStation camera = camera_of(eye);
  for (const ScreenPosition& position : positions) {
    const Vector3<double> n = unit_of(in_frame(eye, direction_from_pixel(projection, position.x_px, position.y_px)));
    const Vector3<double> sky = turned_to_camera(camera, trace_closed_form(camera.spin, start_ray(camera, n)).sky);
    catalogue.stars.push_back({static_cast<std::uint32_t>(catalogue.stars.size()),
                               std::atan2(sky.y, sky.x) * 180.0 / pi,
                               std::atan2(sky.z, std::hypot(sky.x, sky.y)) * 180.0 / pi, 1.0F, 0.5F});
  }
  return catalogue;
}

//! Returns positions at corners of pixels, and in the middle of their sides and diagonals.
std::vector<ScreenPosition> positions_between_pixels(int width_px, int height_px) {
  std::vector<ScreenPosition> positions;
  for (int y = 1; y < height_px; y += 3) {
    for (int x = 0; x < width_px; x += 5) {
      for (const double beside : {0.0, 0.5}) {
        positions.push_back({x + beside, static_cast<double>(y)});
        positions.push_back({static_cast<double>(x), y + beside});
        positions.push_back({x + beside, y + beside});
      }
    }
  }
  return positions;
}

TEST(GatheredStar, BetweenPixelsBelongsToOneOfThem) {
  // The picture covers a full turn, so its left and right edges are adjacent, too.
  const Projection projection = make_equirectangular_projection(128, 64);
  const EyeCamera eye = eye_at_position({0.9, 50.0, 1.0, 0.3, ObserverMotion::zamo});
  const std::vector<ScreenPosition> positions = positions_between_pixels(128, 64);
  const StarField field(stars_at(eye, projection, positions), glm::dmat3(1.0), colours().view());
  std::vector<int> seen(positions.size());
  for (const GatheredStar& star :
       gather_stars(field, StarTree(field), colours().view(), eye, projection, settings_for(20.0)).stars) {
    const std::uint32_t number = field.stars()[static_cast<std::size_t>(star.star)].number;
    const ScreenPosition there = position_of(star);
    const double across = std::remainder(there.x_px - positions[number].x_px, 128.0);
    seen[number] += std::hypot(across, there.y_px - positions[number].y_px) < 0.5 ? 1 : 0;
  }
  std::size_t compared = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // The shadow is straight ahead. Around it, the curved sides of a pixel differ too much from
    // straight lines between its corners.
    if (std::hypot(positions[i].x_px - 64.0, positions[i].y_px - 32.0) > 12.0) {
      EXPECT_EQ(seen[i], 1) << positions[i].x_px << ", " << positions[i].y_px;
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000U);
}

TEST(GatheredStar, IsAnImageInItsOwnPixel) {
  const EyeCamera eye = eye_at_position(positions[2]);
  const StarField field(brightest(3000), glm::dmat3(1.0), colours().view());
  for (const Projection& projection : {make_pinhole_projection(96, 64, 1.5), make_dome_projection(64, pi, pi / 3),
                                       make_equirectangular_projection(128, 64)}) {
    const GatheredStars gathered =
        gather_stars(field, StarTree(field), colours().view(), eye, projection, settings_for(12.0));
    const std::vector<StarImage> images = star_images(gathered.stars, eye, projection);
    ASSERT_EQ(images.size(), gathered.stars.size());
    EXPECT_GT(images.size(), 100U);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const ScreenPosition position = on_screen(eye, projection, images[i].direction);
      EXPECT_EQ(std::floor(position.x_px), gathered.stars[i].x_px);
      EXPECT_EQ(std::floor(position.y_px), gathered.stars[i].y_px);
      EXPECT_EQ(images[i].illuminance.y, gathered.stars[i].illuminance.y);
    }
  }
}

TEST(GatheredStar, HasItsOwnLightWithoutMagnification) {
  const Projection projection = make_dome_projection(64, pi, pi / 3);
  const EyeCamera eye = eye_at_position(positions[2]);
  const StarField field(brightest(100), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(20.0);
  settings.magnification = false;
  const GatheredStars gathered = gather_stars(field, StarTree(field), colours().view(), eye, projection, settings);
  EXPECT_GT(gathered.stars.size(), 50U);
  for (const GatheredStar& star : gathered.stars) {
    const auto own = static_cast<double>(field.stars()[static_cast<std::size_t>(star.star)].illuminance);
    EXPECT_NEAR(luminance(star.illuminance) / own, 1.0, 1e-3);
  }
}

TEST(GatheredStar, IsNowhereWithoutStars) {
  const StarField field({}, glm::dmat3(1.0), colours().view());
  const Projection projection = make_dome_projection(32, pi, 0.0);
  EXPECT_TRUE(gather_stars(field, StarTree(field), colours().view(), eye_at_position(positions[0]), projection,
                           settings_for(9.0))
                  .stars.empty());
}

TEST(StarTree, FindsTheStarsThatLieNear) {
  const StarField field(brightest(2000), glm::dmat3(1.0), colours().view());
  const StarTree tree(field);
  std::vector<int> found;
  for (int i = 0; i < 100; ++i) {
    const Vector3<double> middle = unit_of({std::sin(1.3 * i), std::cos(2.1 * i), std::sin(0.7 * i + 1.0)});
    const double chord = 0.003 * i;
    std::vector<int> expected;
    for (std::size_t star = 0; star < field.stars().size(); ++star) {
      const Vector3<double> apart = field.stars()[star].direction - middle;
      if (dot(apart, apart) < chord * chord) {
        expected.push_back(static_cast<int>(star));
      }
    }
    tree.search(middle, chord, found);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace ergodome
