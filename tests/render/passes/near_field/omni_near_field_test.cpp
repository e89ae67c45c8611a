#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "kernels/near_rays/near_ray.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "tests/render/omni_eyes.h"
#include "tests/render/stereo_scene.h"
#include "tests/support/sanitized.h"

// Tests of disks, shells and objects near the hole, as eyes of the stereo model `omni` see them.
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

//! Compares the rays of an eye with those of separate cameras for each direction. Returns the
//! largest difference of their start values, relative to the largest value of each kind.
double largest_difference(const std::string& position, double half_baseline, double convergence) {
  const Show show = show_of_eyes("model = \"omni\"\n", "projection = \"dome\"\n", position);
  const CameraPose pose = camera_pose(show, 0.0);
  const EyeAtOffset eye_at = [&](const Vector3<double>& offset) { return eye_camera(show, pose, offset); };
  const OmniCamera cameras(Backend::cpu, eye_at, {half_baseline, convergence, pi / 3.0, 0.5 * pi, 1e-6});
  const double head_phi = eye_at({0.0, 0.0, 0.0}).phi;
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double y = -0.98 + 1.96 * i / 499.0;
    const double azimuth = 2.39996 * i;
    const double level = std::sqrt(1.0 - y * y);
    const Vector3<double> view = {level * std::sin(azimuth), y, -level * std::cos(azimuth)};
    for (const double side : {-1.0, 1.0}) {
      const auto [camera, n] = direct_ray(eye_at, view, side * half_baseline, convergence);
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

//! Rays of a camera on the equator start in the plane of the disk, which does not count as a
//! crossing.
TEST(OmniNearField, RaysOfEyesOnTheEquatorBeginOnIt) {
  const Show show = show_of_eyes("model = \"omni\"\n", "projection = \"dome\"\n", "r = 9\ntheta_deg = 90\n");
  const EyeAtOffset eye_at = [&](const Vector3<double>& offset) {
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
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nposition = [4, 5, 1]\nsize = 2\n",
    "[disk]\ninner = 3\nouter = 14\nexposure = 6\n[[shells]]\nradius = 6\nfill_color = [0.1, 0.1, 0.4]\nfill_opacity = "
    "0.4\n"
    "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nposition = [4, 5, 1]\nsize = 2\n"};

constexpr int panorama_px = sanitized ? 37 : 73;

//! Returns the pixel (x, y) of one eye in a side-by-side picture.
const float* pixel_of(const Picture& both, int eye, int x, int y) {
  return both.rgba.data() + 4 * static_cast<std::size_t>(y * both.width + eye * both.width / 2 + x);
}

//! Returns a panorama of both eyes side by side. The camera is rotated to the right by `columns`
//! columns of it.
Picture panorama(const char* scene, const char* model, int columns) {
  const std::string yaw = std::to_string(360.0 * columns / panorama_px);
  const Show show = show_of_eyes(std::string("baseline = 1\nmodel = \"") + model + "\"\n" + scene,
                                 "projection = \"equirect\"\n", "r = 9\ntheta_deg = 70\nyaw_deg = " + yaw + "\n");
  ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
  return renderer.render_window(camera_pose(show, 0.0),
                                make_equirectangular_projection(panorama_px, panorama_px / 2 + 1), ViewMode::sky);
}

//! Returns the largest difference of the color channels of two pixels, relative to their light.
float pixel_difference(const float* own, const float* other) {
  float difference = 0.0F;
  for (int part = 0; part < 3; ++part) {
    difference = std::max(difference, std::abs(own[part] - other[part]) / (0.05F + own[part]));
  }
  return difference;
}

//! Result of comparing columns of an omnidirectional panorama with the middle column of a panorama
//! whose camera is rotated to the same direction.
struct ColumnsApart {
  int looked_at = 0;
  int near = 0;       //!< number of pixels that show a part of the scene near the hole
  int different = 0;  //!< number of pixels that differ by more than a fiftieth
  float largest = 0.0F;
};

void compare_columns(const char* scene, const Picture& omni, int columns, ColumnsApart& sum) {
  const Picture ahead = panorama(scene, "physical", columns);
  const Picture empty = panorama("", "physical", columns);
  constexpr int rows = panorama_px / 2 + 1;
  // Only rows at elevations up to 60 degrees are compared, where the baseline is not reduced.
  for (int y = panorama_px / 10; y < rows - panorama_px / 10; ++y) {
    for (const int eye : {0, 1}) {
      const float* const own = pixel_of(ahead, eye, panorama_px / 2, y);
      const float difference = pixel_difference(own, pixel_of(omni, eye, panorama_px / 2 + columns, y));
      ++sum.looked_at;
      sum.near += pixel_difference(own, pixel_of(empty, eye, panorama_px / 2, y)) > 0.02F ? 1 : 0;
      sum.different += difference > 0.02F ? 1 : 0;
      sum.largest = std::max(sum.largest, difference);
    }
  }
}

//! In each direction, omnidirectional stereo eyes must see what a camera sees that is rotated to
//! this direction and has its eyes to the left and right.
TEST(OmniNearField, IsSeenAsByCamerasThatAreTurnedToEachDirection) {
  for (const char* const scene : near_scenes) {
    SCOPED_TRACE(scene);
    const Picture omni = panorama(scene, "omni", 0);
    ColumnsApart sum;
    for (const int part : {0, 5, 9, 10, -9}) {
      compare_columns(scene, omni, part * panorama_px / 73, sum);
    }
    // Pixels at the same direction have slightly different widths in the two panoramas, so that
    // lines and edges are smoothed slightly differently.
    EXPECT_LE(sum.different, sum.looked_at / 30);
    EXPECT_LT(sum.largest, 0.5F);
    EXPECT_GT(sum.near, sanitized ? 3 : 8);
  }
}

TEST(OmniNearField, IsWhatOneEyeSeesWithoutABaseline) {
  constexpr int size_px = 48;
  for (const char* const scene : near_scenes) {
    SCOPED_TRACE(scene);
    const auto picture = [&](StereoLayout layout, double baseline) {
      Show show = show_of_eyes(std::string("model = \"omni\"\n") + scene, "projection = \"dome\"\n");
      show.stereo.layout = layout;
      show.stereo.baseline = baseline;
      ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
      return renderer.render_window(camera_pose(show, 0.0), make_dome_projection(size_px, pi, 0.4), ViewMode::sky);
    };
    const Picture mono = picture(StereoLayout::mono, 0.0);
    const Picture eyes = picture(StereoLayout::separate, 0.0);
    const Picture close = picture(StereoLayout::separate, 1e-6);
    int apart = 0;
    for (int y = 0; y < size_px; ++y) {
      for (int x = 0; x < size_px; ++x) {
        const float* const one = mono.rgba.data() + 4 * static_cast<std::size_t>(y * size_px + x);
        for (const int eye : {0, 1}) {
          ASSERT_LT(pixel_difference(one, pixel_of(eyes, eye, x, y)), 1e-3F) << x << " " << y;
          apart += pixel_difference(one, pixel_of(close, eye, x, y)) > 1e-2F ? 1 : 0;
        }
      }
    }
    EXPECT_LE(apart, 2 * size_px * size_px / 200);
  }
}

}  // namespace
}  // namespace ergodome
