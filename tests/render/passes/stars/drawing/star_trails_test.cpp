#include "render/passes/stars/drawing/star_trails.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/projection/make_projection.h"
#include "render/passes/stars/drawing/star_splat.h"
#include "tests/render/passes/stars/star_cameras.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Returns positions of a camera while a shutter is open. The camera moves around the spin axis by
//! 0.05 rad to both sides of a position, and slightly inwards.
Shutter orbit_about(const EyeCamera& eye) {
  Shutter shutter;
  for (int i = -4; i <= 4; ++i) {
    EyeCamera moved = eye;
    moved.phi += 0.0125 * i;
    moved.r *= 1.0 - 0.0002 * i;
    shutter.eyes.emplace_back(moved);
  }
  return shutter;
}

double angle_between(const Vector3<float>& a, const Vector3<float>& b) {
  const Vector3<double> apart = widened(a) - widened(b);
  return std::sqrt(dot(apart, apart));
}

//! Returns the illuminance that the pixels of a picture have from these points [lx].
double light_in_picture(const std::vector<StarPoint>& points, const Projection& projection) {
  std::vector<float> rgba(4 * static_cast<std::size_t>(projection.width_px) *
                          static_cast<std::size_t>(projection.height_px));
  splat_points(points, projection, {0.5, 1.0F}, 0, projection.height_px, rgba.data());
  return light_of(rgba, projection);
}

TEST(StarTrails, EndWhereTheImagesAreWhenTheShutterOpensAndCloses) {
  const EyeCamera eye = eye_at_position(positions[0]);
  const StarField field(brightest(300), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(6.0));
  const Shutter shutter = orbit_about(eye);
  const auto trails = star_trails(images, field, shutter, fine_pixel);
  ASSERT_EQ(trails.ways.size(), images.size());
  std::size_t together = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const StarEye& end = side == 0 ? shutter.eyes.front() : shutter.eyes.back();
    const auto there = images_of(field, end.camera, settings_for(7.0));
    for (std::size_t i = 0; i < images.size(); ++i) {
      double nearest = 1.0;
      for (const StarImage& image : there) {
        if (image.star == images[i].star) {
          nearest = std::min(nearest, angle_between(image.direction, trails.directions[9 * i + 8 * side]));
        }
      }
      together += nearest < 0.05 * fine_pixel ? 1U : 0U;
    }
  }
  // While the camera moves by a tenth of a radian, a few images merge at a caustic or disappear
  // behind the edge of the shadow.
  EXPECT_GE(static_cast<double>(together), 0.99 * 2.0 * static_cast<double>(images.size()));
}

TEST(StarTrails, KeepTheLightOfTheirImages) {
  const EyeCamera eye = eye_at_position(positions[0]);
  const StarField field(brightest(300), glm::dmat3(1.0), colours().view());
  std::vector<StarImage> images = images_of(field, eye, settings_for(6.0));
  // Keeps only images that are well inside the picture during the whole motion, and that are not
  // about to merge with another image.
  std::erase_if(images, [](const StarImage& image) {
    return image.direction.x > -0.4F || std::abs(image.magnification) > 10.0F;
  });
  ASSERT_GT(images.size(), 30U);
  const Projection projection = make_dome_projection(1024, pi, 0.0);
  const Shutter shutter = orbit_about(eye);
  const auto trails = star_trails(images, field, shutter, pi / 1024);
  const auto points = trail_points(trails, shutter, projection, {0.5, 1.0F});
  EXPECT_GT(points.size(), 10 * images.size());
  EXPECT_NEAR(light_in_picture(points, projection) /
                  light_in_picture(star_points(images, eye, projection, {0.5, 1.0F}), projection),
              1.0, 0.01);
}

TEST(StarTrails, OfAStillCameraArePoints) {
  const EyeCamera eye = eye_at_position(positions[1]);
  const StarField field(brightest(200), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(6.0));
  const Projection projection = make_dome_projection(1024, pi, 0.0);
  const Shutter shutter = {{eye, eye, eye}};
  const auto trailed = trail_points(star_trails(images, field, shutter, pi / 1024), shutter, projection, {0.5, 1.0F});
  const auto still = star_points(images, eye, projection, {0.5, 1.0F});
  ASSERT_EQ(trailed.size(), 2 * still.size());
  EXPECT_NEAR(light_in_picture(trailed, projection) / light_in_picture(still, projection), 1.0, 1e-4);
}

TEST(StarTrails, OfATurningHeadAreAsLongAsTheTurn) {
  const EyeCamera eye = eye_at_position(positions[0]);
  const StarField field(brightest(300), glm::dmat3(1.0), colours().view());
  std::vector<StarImage> images = images_of(field, eye, settings_for(6.0));
  // Keeps only images near the middle of the picture. A roll would not move them, so the head turns
  // about the x axis of the view, which is e_φ.
  std::erase_if(images, [](const StarImage& image) { return image.direction.x > -0.9F; });
  ASSERT_GT(images.size(), 3U);
  Shutter shutter = {{eye, eye, eye}};
  const auto turn = [&](EyeCamera& turned, double angle) {
    for (auto& row : turned.frame_from_view) {
      const double up = row[1];
      const double back = row[2];
      row[1] = std::cos(angle) * up + std::sin(angle) * back;
      row[2] = std::cos(angle) * back - std::sin(angle) * up;
    }
  };
  turn(shutter.eyes[0].camera, -0.02);
  turn(shutter.eyes[2].camera, 0.02);
  // Keeps only the brightest image. It is not next to the edge of the shadow, where the rotation
  // could lose it.
  images = {*std::ranges::max_element(images, {}, [](const StarImage& image) { return image.illuminance.y; })};
  const Projection projection = make_dome_projection(1024, pi, 0.0);
  const auto points = trail_points(star_trails(images, field, shutter, pi / 1024), shutter, projection, {0.5, 1.0F});
  ASSERT_GT(points.size(), 10U);
  const double length = points.back().y_px - points.front().y_px;
  // The first and the last point are half a step away from the ends of the trail, which the
  // tolerance covers.
  EXPECT_NEAR(length, 0.04 / (pi / 1024), 0.08 * length);
}

TEST(StarTrails, CrossThePictureSeamTheShortWay) {
  const EyeCamera eye = eye_at_position(positions[2]);
  const Projection projection = make_equirectangular_projection(512, 256);
  StarTrails trails;
  // The trail is behind the viewer, where the left and right edges of the picture meet: the view
  // direction is -e_r, and its right is e_φ.
  trails.positions = 3;
  trails.directions = {{0.995F, 0.0F, -0.0998F}, {1.0F, 0.0F, 0.0F}, {0.995F, 0.0F, 0.0998F}};
  trails.ways = {{0, 2, {1.0F, 1.0F, 1.0F}}};
  const Shutter shutter = {{eye, eye, eye}};
  const auto points = trail_points(trails, shutter, projection, {0.0, 1.0F});
  EXPECT_NEAR(static_cast<double>(points.size()), 2.0 * 0.2 / (2.0 * pi) * 512, 3.0);
  const auto behind = trail_points(trails, shutter, make_equirectangular_projection(256, 256, pi), {0.0, 1.0F});
  EXPECT_TRUE(behind.empty()) << "it does not cross a picture of what is in front";
}

}  // namespace
}  // namespace ergodome
