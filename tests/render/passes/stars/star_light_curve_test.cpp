#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/projection/make_projection.h"
#include "render/passes/stars/drawing/star_splat.h"
#include "tests/render/exact_sky.h"
#include "tests/render/passes/stars/image_courses.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

constexpr int frames = 600;
constexpr int curve_size_px = 1024;
constexpr double curve_pixel = pi / curve_size_px;

//! Images of some stars while a camera goes around the hole in 600 steps.
class LightCurve : public testing::Test {
 protected:
  LightCurve()
      : eye_(eye_at_position({0.9, 8.0, 1.3, 0.0, ObserverMotion::zamo})),
        field_(brightest(60), glm::dmat3(1.0), colours().view()),
        settings_(settings_for(5.0)),
        projection_(make_dome_projection(curve_size_px, pi, 0.0)) {
    settings_.pixel = curve_pixel;
    settings_.redshift = true;
    station_ = build_star_station(eye_, settings_);
  }

  //! Returns the star images in a frame. The grid is the same for all frames, because the camera
  //! only moves around the spin axis.
  std::vector<StarImage> images_of_frame(int frame) {
    eye_.phi = 2.0 * pi * frame / frames;
    return find_star_images(field_, colours().view(), eye_, station_,
                            star_patches(field_, colours().view(), eye_, station_, settings_), settings_);
  }

  //! Draws a picture of a single star image. Returns the illuminance of the pixels around it; 0 if
  //! it is outside the picture.
  double light_in_picture(const StarImage& image) {
    const auto points = star_points({image}, eye_, projection_, splat_);
    if (points.empty()) {
      return 0.0;
    }
    const int row = static_cast<int>(points[0].y_px);
    const int column = static_cast<int>(points[0].x_px);
    constexpr int reach = 3;
    if (row < reach || row >= curve_size_px - reach || column < reach || column >= curve_size_px - reach) {
      return 0.0;
    }
    std::vector<float> rows(4UL * curve_size_px * (2 * reach + 1));
    splat_points(points, projection_, splat_, row - reach, 2 * reach + 1, rows.data());
    double sum = 0.0;
    for (int y = 0; y <= 2 * reach; ++y) {
      for (int x = column - reach; x <= column + reach; ++x) {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * curve_size_px + static_cast<std::size_t>(x));
        sum += static_cast<double>(rows[at + 1]) * solid_angle(x + 0.5, row - reach + y + 0.5);
      }
    }
    return sum;
  }

  double solid_angle(double x, double y) const {
    using D = Dual<double>;
    const Vector3<D> n = direction_from_pixel(projection_, D(x, 1.0, 0.0), D(y, 0.0, 1.0));
    const Vector3<double> area = cross(Vector3<double>{n.x.along_x, n.y.along_x, n.z.along_x},
                                       Vector3<double>{n.x.along_y, n.y.along_y, n.z.along_y});
    return std::sqrt(dot(area, area));
  }

  EyeCamera eye_;
  StarField field_;
  StarSettings settings_;
  LensStation station_;
  Projection projection_;
  SplatSettings splat_{0.5, 1.0F};
};

TEST_F(LightCurve, OfEveryImageIsExactInEveryFrameOfAnOrbit) {
  std::size_t compared = 0;
  std::size_t wrong = 0;
  for (int frame = 0; frame < frames; frame += sanitized ? 100 : 1) {
    const auto images = images_of_frame(frame);
    const CameraStation camera = camera_of(eye_);
    for (const StarImage& image : images) {
      const double shown = light_in_picture(image);
      // Skips images near a caustic, where the disk of a star covers a range of magnifications, and
      // images at the rim of the dome, which cuts them off.
      if (!(shown > 0.0) || std::abs(image.magnification) > 50.0F || std::abs(image.direction.y) < 0.02F) {
        continue;
      }
      const FieldStar& star = field_.stars()[static_cast<std::size_t>(image.star)];
      const ImageError exact = error_of(camera, unit_of(widened(image.direction)), star.direction);
      const Vector3<float> light = star_light(colours().view(), star.log_temperature, star.illuminance,
                                              image.frequency_ratio, static_cast<float>(exact.magnification));
      ++compared;
      wrong += std::abs(shown / static_cast<double>(light.y) - 1.0) > 0.02 ? 1U : 0U;
    }
  }
  EXPECT_GT(compared, sanitized ? 100U : 20'000U);
  EXPECT_EQ(wrong, 0U);
}

TEST_F(LightCurve, OfAnImageEndsWhereItMergesWithAnotherAlone) {
  if (sanitized) {
    GTEST_SKIP() << "many frames";
  }
  std::vector<StarImage> before = images_of_frame(0);
  std::size_t followed = 0;
  std::size_t lost = 0;
  for (int frame = 1; frame < frames; ++frame) {
    const auto now = images_of_frame(frame);
    followed += static_cast<std::size_t>(
        std::ranges::count_if(before, [&](const StarImage& image) { return must_go_on(image, settings_); }));
    lost += images_lost(before, now, settings_);
    before = now;
  }
  EXPECT_GT(followed, 20'000U);
  EXPECT_EQ(lost, 0U);
}

}  // namespace
}  // namespace ergodome
