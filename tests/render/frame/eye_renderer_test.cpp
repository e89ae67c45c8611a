#include "render/frame/eye_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/image/color_map.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/lens/direct_lens.h"
#include "tests/render/eye_at.h"

namespace ergodome {
namespace {

using test::eye_at;

SkyCube white_sky() {
  return {Backend::cpu, 16, [](const glm::dvec3&) { return glm::vec3(1.0F); }};
}

//! The lens channels of a picture, in host memory.
struct LensOfEye {
  std::vector<float> store;
  LensPixels pixels{};
  explicit LensOfEye(std::size_t count) : store(14 * count) {
    float* next = store.data();
    const auto take = [&] {
      float* channel = next;
      next += count;
      return channel;
    };
    for (int i = 0; i < 3; ++i) {
      pixels.sky[i] = take();
      pixels.sky_along_x[i] = take();
      pixels.sky_along_y[i] = take();
    }
    pixels.coverage = take();
    pixels.frequency_ratio = take();
    pixels.steps = take();
    pixels.error_estimate = take();
    pixels.half_orbits = take();
  }
};

TEST(DirectLens, PixelsShowTheSkyOfTheClosedForm) {
  const EyeCamera eye = eye_at(0.999, 5.0, 1.2);
  const Projection projection = make_dome_projection(128, pi, 0.6);
  LensOfEye lens(128 * 128);
  const DirectLens source(Backend::cpu, eye, projection, 0.01);
  source.fill(0, 128, lens.pixels);
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  std::vector<double> errors;
  for (int y = 0; y < 128; y += 3) {
    for (int x = 0; x < 128; x += 3) {
      const int i = 128 * y + x;
      if (lens.pixels.coverage[i] < 1.0F) {
        continue;
      }
      const Vector3<double> v = direction_from_pixel(projection, x + 0.5, y + 0.5);
      const auto row = [&](int k) {
        return eye.frame_from_view[k][0] * v.x + eye.frame_from_view[k][1] * v.y + eye.frame_from_view[k][2] * v.z;
      };
      const RayEnd<double> exact =
          trace_closed_form(camera.spin, start_ray(camera, Vector3<double>{row(0), row(1), row(2)}));
      errors.push_back(std::hypot(lens.pixels.sky[0][i] - exact.sky.x, lens.pixels.sky[1][i] - exact.sky.y,
                                  lens.pixels.sky[2][i] - exact.sky.z));
    }
  }
  ASSERT_GT(errors.size(), 500U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 1e-4);
  EXPECT_LT(errors[errors.size() * 95 / 100], 1e-3);
}

TEST(DirectLens, FootprintsAreTheDifferencesOfNeighbours) {
  const Projection projection = make_dome_projection(512, pi, 0.6);
  LensOfEye lens(512 * 512);
  const DirectLens source(Backend::cpu, eye_at(0.9, 8.0), projection, 0.01);
  source.fill(0, 512, lens.pixels);
  std::vector<double> relative;
  for (int i = 512 * 100; i < 512 * 300; i += 7) {
    if (lens.pixels.coverage[i - 1] < 1.0F || lens.pixels.coverage[i] < 1.0F || lens.pixels.coverage[i + 1] < 1.0F) {
      continue;
    }
    double difference = 0.0;
    double size = 0.0;
    for (const auto k : {0, 1, 2}) {
      const double quotient = 0.5 * (lens.pixels.sky[k][i + 1] - lens.pixels.sky[k][i - 1]);
      difference += std::pow(quotient - lens.pixels.sky_along_x[k][i], 2);
      size += quotient * quotient;
    }
    relative.push_back(std::sqrt(difference / size));
  }
  ASSERT_GT(relative.size(), 1000U);
  std::sort(relative.begin(), relative.end());
  EXPECT_LT(relative[relative.size() / 2], 1e-3);
  EXPECT_LT(relative[relative.size() * 9 / 10], 1e-2);
}

TEST(EyeRenderer, ShadowCoversItsSolidAngleToAFractionOfAPixel) {
  // In Schwarzschild spacetime, a static observer at r = 10 sees the shadow as a disk of known
  // angular radius. So the number of dark pixels is known.
  const double radius = std::asin(std::sqrt(27.0 * 0.8) / 10.0);
  for (const int size : {101, 400}) {
    const Projection projection = make_pinhole_projection(size, size, 1.6);
    const Picture picture = EyeRenderer(Backend::cpu).render(eye_at(0.0, 10.0), projection, white_sky(), {});
    double dark = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      dark += 1.0 - picture.rgba[i];
    }
    const double radius_px = std::tan(radius) / std::tan(0.8) * size / 2;
    EXPECT_NEAR(dark / (pi * radius_px * radius_px), 1.0, 2e-3) << size;
  }
}

TEST(EyeRenderer, EdgeOfTheShadowIsSmooth) {
  // In a row across the edge of the shadow, the light of a white sky decreases to 0 within two
  // pixels, and does not increase again.
  const Projection projection = make_pinhole_projection(301, 301, 1.6);
  const Picture picture = EyeRenderer(Backend::cpu).render(eye_at(0.999, 8.0), projection, white_sky(), {});
  for (const int row : {100, 150, 171}) {
    int partial = 0;
    float last = 1.0F;
    for (int x = 0; x <= 150; ++x) {
      const float light = picture.rgba[4 * static_cast<std::size_t>(row * 301 + x)];
      EXPECT_LE(light, last + 1e-5F) << row << " " << x;
      partial += light > 1e-3F && light < 0.999F ? 1 : 0;
      last = light;
    }
    EXPECT_LE(partial, 6) << row;
    EXPECT_GE(partial, 1) << row;
  }
}

TEST(EyeRenderer, BlocksOfRowsMakeOnePicture) {
  // The picture is larger than one block of pixels. It is compared with its parts, computed
  // separately. Most of it is shadow, which takes little time.
  const EyeCamera eye = eye_at(0.9, 6.0);
  const Projection projection = make_pinhole_projection(2048, 1024, 1.6);
  LensOfEye lens(2048 * 1024);
  const DirectLens source(Backend::cpu, eye, projection, 0.05);
  source.fill(700, 324, lens.pixels);
  PictureSettings settings;
  settings.lens = LensChoice::direct;
  const Picture picture = EyeRenderer(Backend::cpu).render(eye, projection, white_sky(), settings);
  double minimum = 1.0;
  double maximum = 0.0;
  for (int i = 0; i < 2048 * 324; i += 1001) {
    const double coverage = lens.pixels.coverage[i];
    EXPECT_NEAR(picture.rgba[4 * static_cast<std::size_t>(700 * 2048 + i) + 3], coverage, 1e-6);
    minimum = std::min(minimum, coverage);
    maximum = std::max(maximum, coverage);
  }
  EXPECT_EQ(minimum, 0.0);
  EXPECT_EQ(maximum, 1.0);
}

TEST(EyeRenderer, FarAwayHoleIsASpeckOfItsArea) {
  const Projection projection = make_pinhole_projection(64, 64, 0.02);
  const Picture picture = EyeRenderer(Backend::cpu).render(eye_at(0.5, 1e5), projection, white_sky(), {});
  double dark = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    dark += 1.0 - picture.rgba[i];
  }
  const double pixel = 2.0 * std::tan(0.01) / 64;
  const double radius_px = 5.2e-5 / pixel;
  EXPECT_GT(dark, 0.3 * pi * radius_px * radius_px);
  EXPECT_LT(dark, 3.0 * pi * radius_px * radius_px);
}

TEST(EyeRenderer, EveryHardCameraGivesAFinitePicture) {
  const SkyCube sky = white_sky();
  EyeRenderer renderer(Backend::cpu);
  for (const double a : {0.0, 0.5, 0.999, 1.0 - 1e-6, 1.0, -1.0}) {
    for (const double above : {1e-6, 0.1, 1.0, 1e6}) {
      for (const double theta : {0.0, 1e-9, pi / 2, pi}) {
        const EyeCamera eye = eye_at(a, horizon_radius(Spacetime{a}) + above, theta);
        const Picture picture = renderer.render(eye, make_dome_projection(48, 2.0 * pi, 0.0), sky, {});
        for (const float value : picture.rgba) {
          ASSERT_TRUE(value >= 0.0F && value <= 1.001F) << a << " " << above << " " << theta;
        }
        // Next to an extremal horizon, light winds too often to count, so a fiftieth of the pixels
        // may be unresolved.
        EXPECT_LE(picture.unresolved_pixels, std::abs(a) == 1.0 ? 36 : 4) << a << " " << above << " " << theta;
      }
    }
  }
}

TEST(EyeRenderer, OnePixelAndOneRowAreImagesToo) {
  const SkyCube sky = white_sky();
  const Picture one = EyeRenderer(Backend::cpu).render(eye_at(0.9, 6.0), make_dome_projection(1, pi, 0.0), sky, {});
  EXPECT_EQ(one.rgba.size(), 4U);
  const Picture row =
      EyeRenderer(Backend::cpu).render(eye_at(0.9, 6.0), make_equirectangular_projection(33, 1), sky, {});
  EXPECT_EQ(row.rgba.size(), 4U * 33U);
}

TEST(EyeRenderer, HeatMapsHaveTheirRangeAndColourOutsideTheShadow) {
  for (const ViewMode mode : {ViewMode::steps, ViewMode::error_estimate, ViewMode::image_order,
                              ViewMode::frequency_ratio, ViewMode::magnification}) {
    PictureSettings settings;
    settings.mode = mode;
    const Picture picture =
        EyeRenderer(Backend::cpu).render(eye_at(0.9, 6.0), make_pinhole_projection(64, 64, 1.5), white_sky(), settings);
    ASSERT_TRUE(picture.heat_range.has_value());
    EXPECT_EQ(picture.rgba[4 * (32 * 64 + 32)], 0.0F);  // the shadow
    EXPECT_GT(picture.rgba[0] + picture.rgba[1] + picture.rgba[2], 0.01F);
  }
}

TEST(EyeRenderer, MagnificationFarFromTheHoleIsOne) {
  PictureSettings settings;
  settings.mode = ViewMode::magnification;
  const Picture picture =
      EyeRenderer(Backend::cpu).render(eye_at(0.0, 1e6), make_pinhole_projection(65, 65, 0.5), white_sky(), settings);
  // A magnification of 1 is in the middle of the logarithmic color scale from 1e-3 to 1e3.
  const Vector3<float> middle = heat_color(0.5F);
  EXPECT_NEAR(picture.rgba[4 * (10 * 65 + 32) + 1], srgb_decoded(middle.y), 0.02F);
}

TEST(EyeRenderer, MagnificationCountsEachPixelsOwnSolidAngle) {
  PictureSettings settings;
  settings.mode = ViewMode::magnification;
  DomeView lens;
  lens.law = LensLaw::orthographic;
  const Vector3<float> middle = heat_color(0.5F);
  for (const Projection& projection :
       {make_equirectangular_projection(64, 32), make_cylinder_projection(64, 64, 3.0, -2.0, 2.0),
        make_cube_projection(16, CubeLayout::strip), make_dome_projection(64, lens)}) {
    const Picture picture = EyeRenderer(Backend::cpu).render(eye_at(0.0, 1e6), projection, white_sky(), settings);
    // The pixel is in the middle of a row near the top, which is next to a pole, an edge or the
    // rim.
    const std::size_t at = 4 * static_cast<std::size_t>(projection.width_px / 2 + projection.width_px);
    EXPECT_NEAR(picture.rgba[at + 1], srgb_decoded(middle.y), 0.02F) << static_cast<int>(projection.kind);
  }
}

}  // namespace
}  // namespace ergodome
