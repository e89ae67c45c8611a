#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/geodesic/closed_form.h"
#include "tests/render/ray_mesh.h"
#include "tests/render/star_cameras.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! The sky that the closed form sees in a direction.
Vector3<double> exact_sky(const CameraStation& camera, const Vector3<double>& n) {
  return turned_to_camera(camera, trace_closed_form(camera.spin, start_ray(camera, unit_of(n))).sky);
}

//! How far an image lies from where the closed form has it, and its exact magnification.
struct ImageError {
  double miss;  //!< [rad]
  double magnification;
};

ImageError error_of(const CameraStation& camera, const Vector3<double>& n, const Vector3<double>& star) {
  const Vector3<double> e1 =
      unit_of(cross(std::abs(n.z) < 0.9 ? Vector3<double>{0, 0, 1} : Vector3<double>{1, 0, 0}, n));
  const Vector3<double> e2 = cross(n, e1);
  const double h = 1e-6;
  const auto derivative = [&](const Vector3<double>& e) {
    return (0.5 / h) * (exact_sky(camera, n + h * e) - exact_sky(camera, n - h * e));
  };
  const Vector3<double> j1 = derivative(e1);
  const Vector3<double> j2 = derivative(e2);
  const Vector3<double> missing = star - exact_sky(camera, n);
  const double a = dot(j1, j1);
  const double b = dot(j1, j2);
  const double c = dot(j2, j2);
  const double determinant = a * c - b * b;
  const double x = (c * dot(j1, missing) - b * dot(j2, missing)) / determinant;
  const double y = (a * dot(j2, missing) - b * dot(j1, missing)) / determinant;
  return {std::hypot(x, y), 1.0 / std::sqrt(determinant)};
}

class StarImages : public testing::TestWithParam<Place> {};

TEST_P(StarImages, AreWhereTheClosedFormHasThem) {
  const EyeCamera eye = eye_at(GetParam());
  const CameraStation camera = camera_of(eye);
  const StarField field(brightest(test::sanitized ? 100 : 1000), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(8.0));
  double worst_px = 0.0;
  double worst_magnification = 0.0;
  for (const StarImage& image : images) {
    const ImageError error = error_of(camera, unit_of(widened(image.direction)),
                                      field.stars()[static_cast<std::size_t>(image.star)].direction);
    worst_px = std::max(worst_px, error.miss / fine_pixel);
    // What the precision of a direction in float leaves of a steep map.
    const double allowance = 1.0 + std::sqrt(error.magnification);
    worst_magnification =
        std::max(worst_magnification, std::abs(std::abs(image.magnification) / error.magnification - 1.0) / allowance);
  }
  EXPECT_GE(images.size(), 1.2 * static_cast<double>(field.stars().size()));
  EXPECT_LT(worst_px, 0.02);
  EXPECT_LT(worst_magnification, 5e-3);
}

TEST_P(StarImages, AreAllThatASearchWithRaysFinds) {
  if (test::sanitized) {
    GTEST_SKIP() << "many rays";
  }
  const EyeCamera eye = eye_at(GetParam());
  const StarField field(brightest(300), glm::dmat3(1.0), colours().view());
  const double faintest = static_cast<double>(settings_for(8.0).faintest);
  // The grid ends half a pixel from the edge.
  const double distance = 0.75 * fine_pixel;
  const ShadowDistance shadow(camera_of(eye));
  std::map<int, std::size_t> by_star;
  for (const StarImage& image : images_of(field, eye, settings_for(8.0))) {
    by_star[image.star] += shadow.of(unit_of(widened(image.direction))) > distance ? 1U : 0U;
  }
  const RayMesh mesh(eye, 0.7 * distance, 1200, 900);
  std::size_t compared = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < field.stars().size(); ++i) {
    // A triangle knows place and magnification roughly: what lies near a limit may be on either side of it.
    const double limit = faintest / static_cast<double>(field.stars()[i].illuminance);
    std::size_t least = 0;
    std::size_t most = 0;
    for (const FoundImage& image : mesh.images(field.stars()[i].direction)) {
      least += image.magnification > 1.15 * limit && image.from_edge > 1.1 * distance ? 1U : 0U;
      most += image.magnification > limit / 1.15 && image.from_edge > 0.9 * distance ? 1U : 0U;
    }
    const std::size_t found = by_star[static_cast<int>(i)];
    different += found < least || found > most ? 1U : 0U;
    compared += most;
  }
  // Next to a caustic the mesh's flat triangles count wrongly.
  EXPECT_LE(different, 2U);
  EXPECT_GT(compared, 400U);
}

TEST_P(StarImages, DoNotDependOnTheGrid) {
  // The same images from a grid four times as fine: none hangs on how cells happen to lie.
  const EyeCamera eye = eye_at(GetParam());
  const StarField field(brightest(test::sanitized ? 100 : 2000), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(9.0);
  const auto coarse = images_of(field, eye, settings);
  GridSettings grid;
  grid.pixel = settings.pixel;
  grid.budget_px = 0.25;
  grid.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  const LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, grid);
  const auto fine = find_star_images(field, colours().view(), eye, station,
                                     star_patches(field, colours().view(), eye, station, settings), settings);
  EXPECT_NEAR(static_cast<double>(coarse.size()), static_cast<double>(fine.size()), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Cameras, StarImages, testing::ValuesIn(places));

TEST(StarImage, OfAFarCameraIsTheStarItself) {
  const EyeCamera eye = eye_at({0.9, 1e5, 1.0, 0.3, ObserverMotion::fixed});
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

TEST(StarImage, OnACausticStaysFinite) {
  // Exactly behind a hole without spin, and so near beside it that float cannot tell.
  for (const double beside : {0.0, 1e-12, 1e-8, 1e-6, 1e-4}) {
    const EyeCamera eye = eye_at({0.0, 8.0, pi / 2, 0.0, ObserverMotion::fixed});
    StarCatalogue catalogue;
    catalogue.stars.push_back({1, 180.0, beside * 180.0 / pi, 1.0F, 0.5F});
    const StarField field(catalogue, glm::dmat3(1.0), colours().view());
    const auto images = images_of(field, eye, settings_for(12.0));
    EXPECT_GE(images.size(), 2U) << beside;
    for (const StarImage& image : images) {
      EXPECT_TRUE(std::isfinite(image.magnification) && std::isfinite(image.illuminance.x)) << beside;
    }
  }
}

TEST(StarImage, NoStarsAndNoLightGiveNoImages) {
  const EyeCamera eye = eye_at(places[0]);
  EXPECT_TRUE(images_of(StarField({}, glm::dmat3(1.0), colours().view()), eye, settings_for(9.0)).empty());
  const StarField field(brightest(100), glm::dmat3(1.0), colours().view());
  EXPECT_TRUE(images_of(field, eye, settings_for(-20.0)).empty());
}

}  // namespace
}  // namespace ergodome
