#include "render/accuracy/references/exact_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "content/camera/camera_path.h"
#include "tests/render/accuracy/accuracy_scene.h"
#include "tests/render/accuracy/cash_karp_ray.h"

namespace ergodome {
namespace {

Vector3<double> unit(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

EyeCamera eye_of(const Show& show) { return eye_camera(show, camera_pose(show, 0.0), 0.0); }

TEST(ExactImages, AreWhereLightOfTheStarArrives) {
  const EyeCamera eye = eye_of(test::small_dome());
  for (const Vector3<double>& n : {Vector3<double>{0.2, 0.9, 0.3}, {1.0, -0.2, 0.1}, {-0.6, -0.7, 0.5}}) {
    const Vector3<double> there = unit(n);
    const Vector3<double> beside = unit(there + Vector3<double>{1e-3, -1e-3, 5e-4});
    const auto image = exact_images(eye, {test::cash_karp_sky(eye, there)}, {beside}, 0.01).front();
    ASSERT_TRUE(image);
    const Vector3<double> off = image->direction - there;
    EXPECT_LT(std::sqrt(dot(off, off)), 1e-8);
  }
}

TEST(ExactImages, AreNotWhereTheStarIsFarFrom) {
  const EyeCamera eye = eye_of(test::small_dome());
  const Vector3<double> there = unit({0.2, 0.9, 0.3});
  EXPECT_FALSE(exact_images(eye, {test::cash_karp_sky(eye, there)}, {unit({0.25, 0.9, 0.3})}, 1e-3).front());
}

TEST(ExactImages, AreNotInTheShadow) {
  const EyeCamera eye = eye_of(test::small_dome());
  EXPECT_FALSE(exact_images(eye, {{0.0, 0.0, 1.0}}, {{-1.0, 0.0, 0.0}}, 1.0).front());
}

TEST(ExactImages, AreMagnifiedByTheBlueShiftOfAFarHoleAlone) {
  // Far from the hole, space is flat. The observer is static, so there is no aberration either.
  Show show = test::small_dome();
  show.camera.keys.front().r = 1e6;
  const EyeCamera eye = eye_of(show);
  const Vector3<double> there = unit({0.8, 0.5, 0.3});
  const auto image = exact_images(eye, {test::cash_karp_sky(eye, there)}, {there}, 1e-3).front();
  ASSERT_TRUE(image);
  EXPECT_NEAR(image->magnification, 1.0, 1e-4);
}

}  // namespace
}  // namespace ergodome
