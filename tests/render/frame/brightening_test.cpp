#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/image/color_map.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "render/lens/direct_lens.h"

namespace ergodome {
namespace {

EyeCamera eye_before_the_hole() {
  const Show show = parse_show("[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 6\n", "brightening.toml");
  return eye_camera(show, camera_pose(show, 0.0), 0.0);
}

//! Returns the light of a white sky with brightening, divided by the coverage, for each pixel.
std::vector<float> brightened(const EyeCamera& eye, const Projection& projection) {
  const SkyCube sky(Backend::cpu, 4, [](const glm::dvec3&) { return glm::vec3(1.0F); });
  PictureSettings settings;
  settings.brightening = true;
  settings.lens = LensChoice::direct;
  const Picture picture = EyeRenderer(Backend::cpu).render(eye, projection, sky, settings);
  std::vector<float> factors;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    factors.push_back(picture.rgba[i + 3] > 0.999F ? picture.rgba[i] / picture.rgba[i + 3] : 0.0F);
  }
  return factors;
}

TEST(Brightening, IsTheSolidAngleOfAPixelOverThatOnTheSky) {
  const EyeCamera eye = eye_before_the_hole();
  for (const Projection& projection : {make_dome_projection(96, pi, 0.5), make_equirectangular_projection(96, 48),
                                       make_pinhole_projection(96, 96, 1.5)}) {
    const auto pixels = static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(projection.height_px);
    std::vector<float> values(14 * pixels);
    LensPixels lens{};
    float* next = values.data();
    for (float** channel :
         {&lens.sky[0], &lens.sky[1], &lens.sky[2], &lens.sky_along_x[0], &lens.sky_along_x[1], &lens.sky_along_x[2],
          &lens.sky_along_y[0], &lens.sky_along_y[1], &lens.sky_along_y[2], &lens.coverage, &lens.error_estimate}) {
      *channel = next;
      next += pixels;
    }
    DirectLens(Backend::cpu, eye, projection, 0.2 * 0.25).fill(0, projection.height_px, lens);
    const std::vector<float> factors = brightened(eye, projection);
    int compared = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto vector = [&](float* const(&from)[3]) {
        return Vector3<double>{static_cast<double>(from[0][i]), static_cast<double>(from[1][i]),
                               static_cast<double>(from[2][i])};
      };
      const Vector3<double> area = cross(vector(lens.sky_along_x), vector(lens.sky_along_y));
      const double on_sky = std::sqrt(dot(area, area));
      const double x = static_cast<double>(i % static_cast<std::size_t>(projection.width_px)) + 0.5;
      const std::size_t row = i / static_cast<std::size_t>(projection.width_px);
      const double y = static_cast<double>(row) + 0.5;
      const double h = 1e-4;
      const Vector3<double> view =
          cross((0.5 / h) * (direction_from_pixel(projection, x + h, y) - direction_from_pixel(projection, x - h, y)),
                (0.5 / h) * (direction_from_pixel(projection, x, y + h) - direction_from_pixel(projection, x, y - h)));
      const double exact = std::sqrt(dot(view, view)) / on_sky;
      if (factors[i] > 0.0F && on_sky < 1.0 && exact < 900.0) {
        EXPECT_NEAR(static_cast<double>(factors[i]) / exact, 1.0, 0.01) << x << " " << y;
        ++compared;
      }
    }
    EXPECT_GT(compared, 2000);
  }
}

TEST(Brightening, IsWhatTheMagnificationViewShows) {
  const EyeCamera eye = eye_before_the_hole();
  const Projection projection = make_pinhole_projection(64, 64, 0.1);
  EyeCamera aside = eye;
  // Rotates the view by a quarter turn, away from the hole.
  for (auto& row : aside.frame_from_view) {
    std::swap(row[0], row[2]);
  }
  const SkyCube sky(Backend::cpu, 4, [](const glm::dvec3&) { return glm::vec3(1.0F); });
  PictureSettings settings;
  settings.mode = ViewMode::magnification;
  const Picture view = EyeRenderer(Backend::cpu).render(aside, projection, sky, settings);
  const std::vector<float> factors = brightened(aside, projection);
  const HeatRange range = heat_range(ViewMode::magnification);
  for (const std::size_t i : {std::size_t{10}, std::size_t{2000}, std::size_t{4000}}) {
    const double position = std::log(static_cast<double>(factors[i]) / range.low) / std::log(range.high / range.low);
    const Vector3<float> colour = heat_color(static_cast<float>(position));
    EXPECT_NEAR(view.rgba[4 * i], srgb_decoded(colour.x), 5e-3F);
    EXPECT_NEAR(view.rgba[4 * i + 1], srgb_decoded(colour.y), 5e-3F);
    EXPECT_NEAR(view.rgba[4 * i + 2], srgb_decoded(colour.z), 5e-3F);
  }
}

}  // namespace
}  // namespace ergodome
