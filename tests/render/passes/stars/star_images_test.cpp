#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/projection/make_projection.h"
#include "tests/render/exact_sky.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/render/ray_mesh.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

class StarImages : public testing::TestWithParam<CameraState> {};

//! Compares star images with the closed form. Expects that positions have errors of at most
//! `max_px` [px of a 4096² dome] and magnifications have relative errors of at most
//! `max_magnification`.
void expect_closed_form(const CameraState& position, double max_px, double max_magnification) {
  const EyeCamera eye = eye_at_position(position);
  const CameraStation camera = camera_of(eye);
  const StarField field(brightest(test::sanitized ? 100 : 1000), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(8.0));
  double worst_px = 0.0;
  double worst_magnification = 0.0;
  for (const StarImage& image : images) {
    const ImageError error = error_of(camera, unit_of(widened(image.direction)),
                                      field.stars()[static_cast<std::size_t>(image.star)].direction);
    worst_px = std::max(worst_px, error.miss / fine_pixel);
    // Allows for the rounding of directions to float, whose effect grows with the magnification.
    const double allowance = 1.0 + std::sqrt(error.magnification);
    worst_magnification =
        std::max(worst_magnification, std::abs(std::abs(image.magnification) / error.magnification - 1.0) / allowance);
  }
  EXPECT_GE(images.size(), 1.2 * static_cast<double>(field.stars().size()));
  EXPECT_LT(worst_px, max_px);
  EXPECT_LT(worst_magnification, max_magnification);
}

TEST_P(StarImages, AreWhereTheClosedFormHasThem) { expect_closed_form(GetParam(), 0.02, 5e-3); }

// Inside the horizon, the lens varies faster than grids can extrapolate.
TEST(StarImagesWithinTheHorizon, AreWhereTheClosedFormHasThem) {
  expect_closed_form({0.9, 1.0, 1.2, 0.3, ObserverMotion::rain}, 0.05, 0.02);
  expect_closed_form({0.0, 0.5, 0.4, 0.3, ObserverMotion::rain}, 0.05, 0.02);
}

TEST_P(StarImages, AreAllThatASearchWithRaysFinds) {
  if (test::sanitized) {
    GTEST_SKIP() << "many rays";
  }
  const EyeCamera eye = eye_at_position(GetParam());
  const StarField field(brightest(300), glm::dmat3(1.0), colours().view());
  const double faintest = static_cast<double>(settings_for(8.0).faintest);
  // The star grid ends at this distance from the edge of the shadow [rad].
  const double distance = 0.02 * fine_pixel;
  const ShadowDistance shadow(camera_of(eye));
  std::map<int, std::size_t> by_star;
  for (const StarImage& image : images_of(field, eye, settings_for(8.0))) {
    by_star[image.star] += shadow.of(unit_of(widened(image.direction))) > distance ? 1U : 0U;
  }
  const RayMesh mesh(eye, 0.7 * distance, 1200, 900);
  std::size_t compared = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < field.stars().size(); ++i) {
    // The reference mesh gives position and magnification of an image only roughly, so images close
    // to a limit may be on either side of it.
    const double limit = faintest / static_cast<double>(field.stars()[i].illuminance);
    std::size_t minimum = 0;
    std::size_t maximum = 0;
    for (const FoundImage& image : mesh.images(field.stars()[i].direction)) {
      minimum += image.magnification > 1.15 * limit && image.from_edge > 1.1 * distance ? 1U : 0U;
      maximum += image.magnification > limit / 1.15 && image.from_edge > 0.9 * distance ? 1U : 0U;
    }
    const std::size_t found = by_star[static_cast<int>(i)];
    different += found < minimum || found > maximum ? 1U : 0U;
    compared += maximum;
  }
  // Near a caustic, the triangles of the mesh are not fine enough, and the number of images is
  // wrong.
  EXPECT_LE(different, 2U);
  EXPECT_GT(compared, 400U);
}

TEST_P(StarImages, DoNotDependOnTheGrid) {
  // Compares with a grid that is five times as fine: the arrangement of cells must not influence
  // which images are found.
  const EyeCamera eye = eye_at_position(GetParam());
  const StarField field(brightest(test::sanitized ? 100 : 2000), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(9.0);
  const auto coarse = images_of(field, eye, settings);
  GridSettings grid;
  grid.pixel = settings.pixel;
  grid.budget_px = 0.003;
  grid.observer = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
  grid.inverted = true;
  const LensStation station = build_lens_station(eye.spacetime, eye.r, eye.theta, grid);
  const auto fine = find_star_images(field, colours().view(), eye, station,
                                     star_patches(field, colours().view(), eye, station, settings), settings);
  // Ignores images at the limit of brightness, and images so close to the edge that further images
  // of higher order are fainter than the limit.
  const ShadowDistance shadow(camera_of(eye));
  const auto counted = [&](const std::vector<StarImage>& images) {
    return std::ranges::count_if(images, [&](const StarImage& image) {
      return image.illuminance.y > 1.1F * settings.faintest &&
             shadow.of(unit_of(widened(image.direction))) > 0.75 * fine_pixel;
    });
  };
  EXPECT_GT(counted(fine), test::sanitized ? 200 : 2000);
  EXPECT_EQ(counted(coarse), counted(fine));
}

INSTANTIATE_TEST_SUITE_P(Cameras, StarImages, testing::ValuesIn(positions));

TEST(StarPatchesOfAPosition, AreTheSameInTheMemoryOfOthers) {
  const StarField field(brightest(500), glm::dmat3(1.0), colours().view());
  const StarSettings settings = settings_for(8.0);
  PatchRoom room;
  // The search reuses the memory of another position: of one with more patches, then of one with
  // fewer.
  for (const CameraState& before : {positions[2], positions[0]}) {
    const EyeCamera eye = eye_at_position(before);
    const LensStation station = build_star_station(eye, settings);
    room.patches = star_patches(field, colours().view(), eye, station, settings, room).given_up();
    const EyeCamera next = eye_at_position(positions[1]);
    const LensStation there = build_star_station(next, settings);
    const StarPatches patches = star_patches(field, colours().view(), next, there, settings, room);
    const StarPatches alone = star_patches(field, colours().view(), next, there, settings);
    ASSERT_EQ(patches.patches().size(), alone.patches().size());
    EXPECT_TRUE(std::ranges::equal(patches.patches(), alone.patches(), [](const StarPatch& a, const StarPatch& b) {
      return a.leaf == b.leaf && a.gamma_turns == b.gamma_turns && a.s == b.s && a.sky.x[5] == b.sky.x[5] &&
             a.seen_radius == b.seen_radius && a.magnification == b.magnification;
    }));
  }
}

TEST_P(StarImages, OfAViewAreThoseOfTheWholeSkyThatLieInIt) {
  EyeCamera eye = eye_at_position(GetParam());
  const StarField field(brightest(test::sanitized ? 200 : 3000), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(8.0);
  const LensStation station = build_star_station(eye, settings);
  const StarPatches patches = star_patches(field, colours().view(), eye, station, settings);
  const auto all = find_star_images(field, colours().view(), eye, station, patches, settings);
  for (const Projection& projection : {make_dome_projection(512, pi, 0.7), make_pinhole_projection(512, 256, 1.0),
                                       make_dome_projection(512, 1.0, 2.0)}) {
    settings.view = view_cone(eye, projection, 0.05);
    const auto seen = find_star_images(field, colours().view(), eye, station, patches, settings);
    const auto points = [&](const std::vector<StarImage>& images) {
      std::vector<StarPoint> inside = star_points(images, eye, projection, {0.5, 1.0F});
      // In the corners of a dome picture, there is no image.
      std::erase_if(
          inside, [&](const StarPoint& point) { return !(image_coverage(projection, point.x_px, point.y_px) > 0.0); });
      std::ranges::sort(inside, {}, &StarPoint::y_px);
      return inside;
    };
    const auto shown = points(seen);
    const auto expected = points(all);
    EXPECT_LT(seen.size(), all.size());
    ASSERT_EQ(shown.size(), expected.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      EXPECT_NEAR(shown[i].y_px, expected[i].y_px, 1e-2);
    }
  }
}

TEST(StarImage, OfAFarCameraIsTheStarItself) {
  const EyeCamera eye = eye_at_position({0.9, 1e5, 1.0, 0.3, ObserverMotion::fixed});
  const StarField field(brightest(1000), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(12.0);
  settings.redshift = true;
  const auto images = images_of(field, eye, settings);
  std::vector<int> seen(field.stars().size());
  for (const StarImage& image : images) {
    const FieldStar& star = field.stars()[static_cast<std::size_t>(image.star)];
    if (std::abs(image.magnification) < 0.5F) {
      continue;
    }
    ++seen[static_cast<std::size_t>(image.star)];
    const float luminance =
        0.2126729F * image.illuminance.x + 0.7151522F * image.illuminance.y + 0.0721750F * image.illuminance.z;
    EXPECT_NEAR(-2.5 * std::log10(luminance / star.illuminance), 0.0, 2e-3) << star.number;
  }
  EXPECT_EQ(std::ranges::count(seen, 1), 1000);
}

//! Returns the magnification of a small disk exactly behind a hole without spin: the solid angle of
//! its image, a ring, divided by its own solid angle. Half of the width of the ring is the radius
//! of the disk divided by the rate at which the sky direction changes with the angle from the hole.
double ring_magnification(const CameraStation& camera, double radius) {
  const auto beside = [&](double alpha) { return exact_sky(camera, {-std::cos(alpha), 0.0, std::sin(alpha)}).y; };
  double low = 0.8;  // outside the shadow, where first-order light passes
  double high = 1.5;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (beside(low) * beside(middle) <= 0.0 ? high : low) = middle;
  }
  const double rate = (beside(low + 1e-5) - beside(low - 1e-5)) / 2e-5;
  return 4.0 * std::sin(low) / (std::abs(rate) * radius);
}

TEST(StarImage, OnACausticIsNoBrighterThanTheRingOfItsDisk) {
  // The star is exactly behind a hole without spin, or so close to this position that the
  // difference does not matter.
  const EyeCamera eye = eye_at_position({0.0, 8.0, pi / 2, 0.0, ObserverMotion::fixed});
  for (const double beside : {0.0, 1e-12, 1e-10}) {
    StarCatalogue catalogue;
    catalogue.stars.push_back({1, 180.0, beside * 180.0 / pi, 1.0F, 0.5F});
    const StarField field(catalogue, glm::dmat3(1.0), colours().view());
    double total = 0.0;
    for (const StarImage& image : images_of(field, eye, settings_for(12.0))) {
      total += std::abs(static_cast<double>(image.magnification));
    }
    const double ring = ring_magnification(camera_of(eye), static_cast<double>(field.stars()[0].radius));
    // The search represents the ring by a few images (arcs), each with the maximum magnification.
    EXPECT_GT(total, ring * 0.8) << beside;
    EXPECT_LT(total, ring * 1.5) << beside;
  }
}

TEST(StarImage, BesideACausticIsOneOfTwo) {
  // A star next to the point of the sky exactly behind the hole has two images with nearly equal
  // magnifications. The magnification of each follows from the derivative of the sky direction by
  // the view direction.
  const EyeCamera eye = eye_at_position({0.0, 8.0, pi / 2, 0.0, ObserverMotion::fixed});
  for (const double beside : {1e-6, 1e-5, 1e-4, 1e-3}) {
    StarCatalogue catalogue;
    catalogue.stars.push_back({1, 180.0, beside * 180.0 / pi, 1.0F, 0.5F});
    const StarField field(catalogue, glm::dmat3(1.0), colours().view());
    double total = 0.0;
    for (const StarImage& image : images_of(field, eye, settings_for(-1.0))) {
      total += std::abs(static_cast<double>(image.magnification));
    }
    // ring_magnification() with `beside` as the radius of a disk is twice the total magnification
    // of a point at this angle from the point of the sky exactly behind the hole.
    const double exact = 0.5 * ring_magnification(camera_of(eye), beside);
    // The tolerance includes the relative rounding error of a ray at such a small distance.
    EXPECT_NEAR(total / exact, 1.0, 0.02 + 3e-8 / beside) << beside;
  }
}

TEST(StarImage, NoStarsAndNoLightGiveNoImages) {
  const EyeCamera eye = eye_at_position(positions[0]);
  EXPECT_TRUE(images_of(StarField({}, glm::dmat3(1.0), colours().view()), eye, settings_for(9.0)).empty());
  const StarField field(brightest(100), glm::dmat3(1.0), colours().view());
  EXPECT_TRUE(images_of(field, eye, settings_for(-20.0)).empty());
}

}  // namespace
}  // namespace ergodome
