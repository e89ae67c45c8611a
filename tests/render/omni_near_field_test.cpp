#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "kernels/near_field/near_ray.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "tests/render/omni_eyes.h"
#include "tests/render/stereo_scene.h"
#include "tests/support/sanitized.h"

// What stands near the hole, seen by eyes that turn with the direction one looks at.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): shows and rays of tests

double apart(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> difference = a - b;
  return std::sqrt(dot(difference, difference));
}

Vector3<double> turned_by(double angle, const Vector3<double>& v) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y, v.z};
}

//! Largest difference of any number of the rays of an eye from those of each direction's own camera, beside the largest of its kind.
double largest_difference(const std::string& place, double half_baseline, double convergence) {
  const Show show = show_of_eyes("model = \"omni\"\n", "projection = \"dome\"\n", place);
  const CameraPose pose = camera_pose(show, 0.0);
  const EyePlace eye_at = [&](const Vector3<double>& offset) { return eye_camera(show, pose, offset); };
  const OmniCamera cameras(Backend::cpu, eye_at, {half_baseline, convergence, pi / 3.0, 0.5 * pi, 1e-6});
  const double head_phi = eye_at({0.0, 0.0, 0.0}).phi;
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double y = -0.98 + 1.96 * i / 499.0;
    const double azimuth = 2.39996 * i;
    const double level = std::sqrt(1.0 - y * y);
    const Vector3<double> view = {level * std::sin(azimuth), y, -level * std::cos(azimuth)};
    for (const double side : {-1.0, 1.0}) {
      const auto [camera, n] = own_ray(eye_at, view, side * half_baseline, convergence);
      const NearRay<double> own = start_near_ray(camera, n);
      const NearRay<double> seen = start_near_ray(cameras.exact(side), view);
      const double phi = std::atan2(camera.sine_phi, camera.cosine_phi) - head_phi;
      const double momentum = std::sqrt(dot(own.m_rate, own.m_rate));
      const double square = momentum * momentum + own.energy * own.energy;
      largest = std::max(
          {largest, std::abs(seen.energy - own.energy), std::abs(seen.u / own.u - 1.0),
           apart(seen.m, turned_by(phi, own.m)), apart(seen.m_rate, turned_by(phi, own.m_rate)) / momentum,
           std::abs(seen.axial_angular_momentum - own.axial_angular_momentum) / momentum,
           std::abs(seen.polar_constant - own.polar_constant) / square, std::abs(seen.carter - own.carter) / square,
           std::abs(seen.shear_constant - own.shear_constant) / square});
    }
  }
  return largest;
}

TEST(OmniNearField, RaysAreThoseOfEachDirectionsOwnCamera) {
  EXPECT_LT(largest_difference("r = 9\ntheta_deg = 70\n", 0.05, 0.0), 1e-5);
  EXPECT_LT(largest_difference("r = 9\ntheta_deg = 70\n", 0.5, 12.0), 1e-5);
  EXPECT_LT(largest_difference("r = 9\ntheta_deg = 90\n", 0.2, 0.0), 1e-5);
  EXPECT_LT(largest_difference("r = 9\ntheta_deg = 0\n", 0.2, 0.0), 1e-5);
  EXPECT_LT(largest_difference("r = 1.6\ntheta_deg = 90\nphi_deg = 250\n", 0.01, 0.0), 1e-5);
}

//! A camera that stays on the equator sees no disk where it stands: its rays do not cross the plane there.
TEST(OmniNearField, RaysOfEyesOnTheEquatorBeginOnIt) {
  const Show show = show_of_eyes("model = \"omni\"\n", "projection = \"dome\"\n", "r = 9\ntheta_deg = 90\n");
  const EyePlace eye_at = [&](const Vector3<double>& offset) {
    return eye_camera(show, camera_pose(show, 0.0), offset);
  };
  const OmniCamera cameras(Backend::cpu, eye_at, {0.1, 0.0, pi / 3.0, 0.5 * pi, 1e-6});
  for (const Vector3<float>& view : {Vector3<float>{0.6F, 0.0F, -0.8F}, Vector3<float>{-0.8F, 0.6F, 0.0F}}) {
    EXPECT_EQ(start_near_ray(cameras.on_host(1.0), view).m.z, 0.0F);
  }
}

constexpr const char* near_scenes[] = {
    "[disk]\ninner = 3\nouter = 14\npattern = \"procedural\"\ncontrast = 0.7\nexposure = 6\n",
    "[[shells]]\nradius = 6\nspacing_deg = 15\nline_width_deg = 2\nline_color = [0.9, 0.3, 0.1]\nfill_color = [0.1, "
    "0.1, 0.4]\n"
    "fill_opacity = 0.4\n",
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nposition = [4, 5, 1]\nsize = 1.5\n",
    "[disk]\ninner = 3\nouter = 14\nexposure = 6\n[[shells]]\nradius = 6\nfill_color = [0.1, 0.1, 0.4]\nfill_opacity = "
    "0.4\n"
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nposition = [4, 5, 1]\nsize = 1.5\n"};

constexpr int panorama_px = sanitized ? 37 : 73;

//! A pixel of one eye, in a picture of both side by side.
const float* pixel_of(const Picture& both, int eye, int x, int y) {
  return both.rgba.data() + 4 * static_cast<std::size_t>(y * both.width + eye * both.width / 2 + x);
}

//! Both eyes side by side of a picture all around, of a camera that is turned by so many of its columns.
Picture panorama(const char* scene, const char* model, int columns) {
  const std::string yaw = std::to_string(360.0 * columns / panorama_px);
  const Show show = show_of_eyes(std::string("baseline = 1\nmodel = \"") + model + "\"\n" + scene,
                                 "projection = \"equirect\"\n", "r = 9\ntheta_deg = 70\nyaw_deg = " + yaw + "\n");
  ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
  return renderer.render_window(camera_pose(show, 0.0),
                                make_equirectangular_projection(panorama_px, panorama_px / 2 + 1), ViewMode::sky);
}

//! What is straight ahead of a turned camera, whose eyes are to its left and right, is what eyes that turn with the direction see there.
TEST(OmniNearField, IsSeenAsByCamerasThatAreTurnedToEachDirection) {
  for (const char* const scene : near_scenes) {
    SCOPED_TRACE(scene);
    const Picture turning = panorama(scene, "omni", 0);
    int looked_at = 0;
    int different = 0;
    float largest = 0.0F;
    float brightest = 0.0F;
    for (const int columns : {0, 5, -9, panorama_px / 2}) {
      const Picture ahead = panorama(scene, "physical", columns);
      for (const int eye : {0, 1}) {
        // The baseline is whole up to 60 degrees.
        for (int y = panorama_px / 10; y < panorama_px / 2 + 1 - panorama_px / 10; ++y) {
          const float* const own = pixel_of(ahead, eye, panorama_px / 2, y);
          const float* const seen = pixel_of(turning, eye, panorama_px / 2 + columns, y);
          float difference = 0.0F;
          for (int part = 0; part < 3; ++part) {
            difference = std::max(difference, std::abs(own[part] - seen[part]) / (0.05F + own[part]));
            brightest = std::max(brightest, own[part]);
          }
          if (difference > 0.02F)
            printf("c %d eye %d y %d own %g %g %g seen %g %g %g\n", columns, eye, y, own[0], own[1], own[2], seen[0],
                   seen[1], seen[2]);
          different += difference > 0.02F ? 1 : 0;
          largest = std::max(largest, difference);
          ++looked_at;
        }
      }
    }
    // Pixels are as wide along the azimuth as cameras beside one another make them: lines and edges are smoothed a little otherwise.
    EXPECT_LE(different, looked_at / 50);
    EXPECT_LT(largest, 0.15F);
    EXPECT_GT(brightest, 0.05F);
  }
}

TEST(OmniNearField, IsTheSameForBothEyesWithoutABaseline) {
  for (const char* const scene : near_scenes) {
    SCOPED_TRACE(scene);
    const Show show =
        show_of_eyes(std::string("baseline = 0\nmodel = \"omni\"\n") + scene, "projection = \"dome\"\nsize_px = 48\n");
    ShowRenderer renderer(show, Backend::cpu);
    const Picture eyes =
        renderer.render_window(camera_pose(show, 0.0), make_projection(show.view, 48, 0.0), ViewMode::sky);
    for (int y = 0; y < 48; ++y) {
      ASSERT_TRUE(std::equal(pixel_of(eyes, 0, 0, y), pixel_of(eyes, 1, 0, y), pixel_of(eyes, 1, 0, y))) << y;
    }
  }
}

}  // namespace
}  // namespace ergodome
