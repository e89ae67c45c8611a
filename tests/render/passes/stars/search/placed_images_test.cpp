#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "kernels/projection/make_projection.h"
#include "render/passes/stars/drawing/point_placer.h"
#include "render/passes/stars/search/image_joiner.h"
#include "tests/render/passes/stars/star_cameras.h"

// The GPU code that processes found star images must give the same results as the CPU code. Here it
// runs on the CPU.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

constexpr int some_stars = 500;
constexpr double dome_pixel = 1e-3;

//! Returns random images of stars. Every fourth image has a duplicate at a tiny distance, and some
//! are invalid.
std::vector<SeenImage> found_images(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> part(-1.0F, 1.0F);
  std::uniform_int_distribution<int> star(-1, some_stars - 1);
  std::vector<SeenImage> found;
  for (int i = 0; i < count; ++i) {
    SeenImage image{{star(random), {part(random), part(random), part(random)}, part(random), 1.0F, {1.0F, 0.5F, 2.0F}},
                    0.0F,
                    false};
    Vector3<float>& way = image.image.direction;
    way = (1.0F / std::sqrt(dot(way, way))) * way;
    image.image.illuminance = (1.0F + static_cast<float>(i % 7)) * image.image.illuminance;
    found.push_back(image);
    if (i % 4 == 0) {
      image.image.direction.x += 0.02F * static_cast<float>(dome_pixel);
      found.push_back(image);
    }
  }
  return found;
}

std::vector<StarImage> joined(std::vector<SeenImage> found, std::size_t in_place,
                              ImageOrder order = ImageOrder::by_position) {
  ImageJoiner joiner(Backend::cpu, some_stars);
  const std::vector<SeenImage> others(found.begin() + static_cast<std::ptrdiff_t>(in_place), found.end());
  const PlacedImages placed = joiner.join({found.data(), static_cast<int>(in_place)}, others, dome_pixel, order);
  std::vector<StarImage> images(placed.images.data(), placed.images.data() + placed.count);
  std::erase_if(images, [](const StarImage& image) { return image.star < 0; });
  return images;
}

//! Returns the expected images by comparing all images with each other.
std::vector<StarImage> joined_slowly(const std::vector<SeenImage>& found, ImageOrder order) {
  std::vector<StarImage> images(found.size());
  std::ranges::transform(found, images.begin(), &SeenImage::image);
  std::ranges::stable_sort(images, [&](const StarImage& a, const StarImage& b) {
    const auto key = [&](const StarImage& image) {
      const Vector3<float> at = order == ImageOrder::by_position ? image.direction : Vector3<float>{};
      return std::tuple(image.star, at.x, at.y, at.z);
    };
    return key(a) < key(b);
  });
  std::vector<StarImage> expected;
  for (const StarImage& image : images) {
    const bool is_new = std::ranges::none_of(expected, [&](const StarImage& other) {
      const Vector3<float> apart = image.direction - other.direction;
      return image.star == other.star && dot(apart, apart) < 1e-8F && image.magnification == other.magnification;
    });
    if (image.star >= 0 && is_new) {
      expected.push_back(image);
    }
  }
  return expected;
}

bool are_the_same(const StarImage& a, const StarImage& b) {
  return a.star == b.star && a.direction.x == b.direction.x && a.direction.y == b.direction.y &&
         a.direction.z == b.direction.z && a.magnification == b.magnification && a.illuminance.x == b.illuminance.x;
}

TEST(PlacedImages, AreWithoutDuplicatesStarByStar) {
  const std::vector<SeenImage> found = found_images(2000);
  for (const ImageOrder order : {ImageOrder::by_position, ImageOrder::as_found}) {
    const std::vector<StarImage> expected = joined_slowly(found, order);
    ASSERT_LT(expected.size(), found.size() - 400);
    for (const std::size_t in_place : {std::size_t{0}, std::size_t{1500}, found.size()}) {
      EXPECT_TRUE(std::ranges::equal(joined(found, in_place, order), expected, are_the_same)) << in_place;
    }
  }
}

TEST(PlacedImages, DoNotDependOnTheOrderInWhichTheyAreFound) {
  std::vector<SeenImage> found = found_images(2000);
  const std::vector<StarImage> before = joined(found, 1000);
  std::ranges::shuffle(found, std::mt19937(3));
  EXPECT_TRUE(std::ranges::equal(joined(found, 1000), before, are_the_same));
}

TEST(PlacedImages, AreNoneWhereNoneAreFound) { EXPECT_TRUE(joined({}, 0).empty()); }

//! Random star images all over the sky, and settings for which some of them have spikes.
struct Sky {
  std::vector<StarImage> images = joined(found_images(1500), 0);
  EyeCamera eye = eye_at_position(positions[0]);
  SplatSettings splat{0.5, 2.0F, 3.0F, 0.3F, 40.0};

  [[nodiscard]] PlacedImages placed() const {
    PlacedImages in_place{Buffer<StarImage>(Backend::cpu, images.size(), "test"), static_cast<int>(images.size())};
    in_place.images.write(images.data(), images.size());
    return in_place;
  }
};

//! Expects that the points placed by PointPlacer equal those computed from images in host memory,
//! in any order.
void expect_points_of(const Sky& sky, const Projection& projection) {
  PointPlacer placer(Backend::cpu);
  const PlacedImages images = sky.placed();
  const PlacedPoints placed = placer.place(images, sky.eye, projection, sky.splat);
  std::vector<StarPoint> points(placed.points, placed.points + placed.count);
  std::erase_if(points, [](const StarPoint& point) { return point.x_px < -1e6; });
  std::vector<StarPoint> expected = star_points(sky.images, sky.eye, projection, sky.splat);
  ASSERT_EQ(points.size(), expected.size());
  const auto key = [](const StarPoint& point) { return std::tuple(point.region, point.y_px, point.x_px); };
  std::ranges::sort(points, {}, key);
  std::ranges::sort(expected, {}, key);
  const auto spiked = std::ranges::count_if(expected, [](const StarPoint& point) { return point.spikes.x > 0.0F; });
  EXPECT_EQ(placed.spiked, spiked);
  EXPECT_GT(spiked, 0);
  EXPECT_TRUE(std::ranges::equal(points, expected, [](const StarPoint& a, const StarPoint& b) {
    return a.x_px == b.x_px && a.y_px == b.y_px && a.region == b.region && a.light.y == b.light.y &&
           a.spikes.z == b.spikes.z;
  }));
}

TEST(PlacedPoints, AreThoseOfImagesOnADome) { expect_points_of(Sky(), make_dome_projection(512, pi, 0.5)); }

TEST(PlacedPoints, AreThoseOfImagesOnAWholeSky) { expect_points_of(Sky(), make_equirectangular_projection(1024, 512)); }

TEST(PlacedPoints, AreOnEachFaceOfACubeThatTheyReach) {
  expect_points_of(Sky(), make_cube_projection(128, CubeLayout::strip));
}

TEST(PlacedPoints, AreNoneWithoutImages) {
  PointPlacer placer(Backend::cpu);
  EXPECT_EQ(placer.place({}, eye_at_position(positions[0]), make_dome_projection(64, pi, 0.0), {}).count, 0);
}

}  // namespace
}  // namespace ergodome
