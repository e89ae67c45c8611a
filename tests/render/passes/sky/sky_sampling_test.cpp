#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "kernels/sky/blackbody.h"
#include "kernels/sky/elliptic_filter.h"
#include "render/frame/show_renderer.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {
namespace {

//! Pixels that sample the sky in the given directions, with footprints of a hundredth of a radian
//! and the given frequency ratio.
class SkySamples {
 public:
  SkySamples(const std::vector<Vector3<float>>& directions, float frequency_ratio)
      : count_(directions.size()), values_(11 * directions.size()), rgba_(4 * directions.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      const Vector3<float> d = directions[i];
      const Vector3<float> axis = std::abs(d.z) < 0.9F ? Vector3<float>{0, 0, 1} : Vector3<float>{1, 0, 0};
      const Vector3<float> across = cross(axis, d);
      const Vector3<float> x = (0.01F / std::sqrt(dot(across, across))) * across;
      const Vector3<float> y = cross(d, x);
      const float parts[] = {d.x, d.y, d.z, x.x, x.y, x.z, y.x, y.y, y.z, 1.0F, frequency_ratio};
      for (std::size_t part = 0; part < 11; ++part) {
        values_[part * count_ + i] = parts[part];
      }
    }
  }

  //! Shades the pixels; returns four floats per pixel.
  const std::vector<float>& shade(const CubeMap& sky, const PictureSettings& settings) {
    LensPixels lens{};
    for (std::size_t i = 0; i < 3; ++i) {
      lens.sky[i] = channel(i);
      // The point filter does not use footprints.
      const bool footprint = settings.filter != SkyFilter::point;
      lens.sky_along_x[i] = footprint ? channel(3 + i) : nullptr;
      lens.sky_along_y[i] = footprint ? channel(6 + i) : nullptr;
    }
    lens.coverage = channel(9);
    lens.frequency_ratio = channel(10);
    const auto count = static_cast<int>(count_);
    if (settings.filter == SkyFilter::polygon) {
      settings.polygons->filter(lens, count, rgba_.data());
    }
    ProjectionOf<float> row{};
    row.width_px = count;
    row.height_px = 1;
    launch(Backend::cpu, ShadeBatch{lens, sky, ViewMode::sky, settings.filter, settings.shift, false, settings.colours,
                                    row, 0, 1.0F, 0.0F, 1.0F, rgba_.data(), count});
    return rgba_;
  }

 private:
  float* channel(std::size_t i) { return values_.data() + i * count_; }

  std::size_t count_;
  std::vector<float> values_;
  std::vector<float> rgba_;
};

std::vector<Vector3<float>> directions_everywhere(int count) {
  std::vector<Vector3<float>> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double phi = 2.399963229728653 * i;
    const double r = std::sqrt(1.0 - z * z);
    directions.push_back(
        {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)});
  }
  return directions;
}

TEST(PointSample, InTheMiddleOfATexelIsTheTexel) {
  const SkyCube sky(Backend::cpu, 16, [](const glm::dvec3& d) {
    return glm::vec3(std::abs(std::sin(91.0 * d.x + 17.0 * d.y)), d.z > 0.0 ? 1.0 : 0.2,
                     std::abs(std::cos(83.0 * d.z)));
  });
  const CubeMap map = sky.view();
  std::vector<Vector3<float>> directions;
  std::vector<Quad> texels;
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < 256; ++i) {
      const int row = i / 16;
      const Vector3<double> d = cube_direction(face, (2 * (i % 16) + 1) / 16.0 - 1.0, (2 * row + 1) / 16.0 - 1.0);
      const double length = std::sqrt(dot(d, d));
      directions.push_back(
          {static_cast<float>(d.x / length), static_cast<float>(d.y / length), static_cast<float>(d.z / length)});
      texels.push_back(map.scale * load_quad(map.texels + texel_index(map, 0, face, i % 16, i / 16)));
    }
  }
  PictureSettings settings;
  settings.filter = SkyFilter::point;
  SkySamples samples(directions, 1.0F);
  const std::vector<float>& rgba = samples.shade(map, settings);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    for (int part = 0; part < 3; ++part) {
      EXPECT_NEAR(rgba[4 * i + static_cast<std::size_t>(part)], quad_part(texels[i], part), 2e-5F);
    }
  }
}

TEST(PointSample, DirectionOfNoLengthSeesTheMean) {
  const SkyCube sky(Backend::cpu, 8, [](const glm::dvec3& d) { return glm::vec3(1.0 + d.x, 0.5, 0.0); });
  const SkyLight<float> light = sample_sky(sky.view(), {0.0F, 0.0F, 0.0F}, 2.0F);
  EXPECT_NEAR(quad_part(light.pixel[0], 0), 2.0F, 1e-4F);
  EXPECT_NEAR(quad_part(light.pixel[0], 1), 1.0F, 1e-6F);
}

Show dome_show(const std::string& sky, const std::string& rest = {}) {
  return parse_show(
      "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 6\n[view]\nsize_px = 64\n[sky]\nmap = \"grid\"\n" + sky + rest,
      "look.toml");
}

EyeCamera eye_of(const Show& show) { return eye_camera(show, camera_pose(show, 0.0), 0.0); }

TEST(PointSample, StoresNoFootprints) {
  const SkyCube sky(Backend::cpu, 8, [](const glm::dvec3&) { return glm::vec3(1.0F); });
  const auto floats_a_pixel = [&](SkyFilter filter, bool brightening) {
    EyeRenderer renderer(Backend::cpu);
    PictureSettings settings;
    settings.filter = filter;
    settings.brightening = brightening;
    const Picture picture = renderer.render(eye_of(dome_show("")), make_dome_projection(64, pi, 0.0), sky, settings);
    // Rays that were not resolved see the mean of the sky. Both this mean and the sky are white, so
    // the light equals the coverage.
    for (std::size_t i = 0; i < picture.rgba.size() && !brightening; i += 4) {
      EXPECT_NEAR(picture.rgba[i], picture.rgba[i + 3], 1e-5F);
    }
    return renderer.lens_floats() / (64 * 64);
  };
  EXPECT_EQ(floats_a_pixel(SkyFilter::ewa, false), 11U);
  EXPECT_EQ(floats_a_pixel(SkyFilter::point, false), 5U);
  EXPECT_EQ(floats_a_pixel(SkyFilter::point, true), 11U);
}

//! The light of a sky with the color of a blackbody, after a frequency shift.
struct Blackened {
  double luminance_ratio;
  //! Chromaticity coordinates x and y by CIE 1931.
  double x;
  double y;
};

Blackened seen_of_blackbody(double temperature_k, double g, SkyFilter filter) {
  const Vector3<double> xyz = blackbody_tristimulus(temperature_k);
  const Vector3<double> rgb = linear_srgb(Vector3<double>{xyz.x / xyz.y, 1.0, xyz.z / xyz.y});
  const glm::vec3 light(rgb.x, rgb.y, rgb.z);
  const BlackbodyColours colours(Backend::cpu);
  const TemperatureFit fit(colours.view());
  const SkyCube sky(
      Backend::cpu, 4, [&](const glm::dvec3&) { return light; }, &fit);
  EnvironmentImage image;
  image.width = 16;
  image.height = 8;
  for (int i = 0; i < 16 * 8; ++i) {
    image.rgb.insert(image.rgb.end(), {light.x, light.y, light.z});
  }
  const PolygonFilter polygons(image, glm::dmat3(1.0), &fit);
  PictureSettings settings;
  settings.filter = filter;
  settings.shift = SkyShift::blackbody_fit;
  settings.colours = colours.view();
  settings.polygons = &polygons;
  SkySamples samples(directions_everywhere(50), static_cast<float>(g));
  const std::vector<float>& rgba = samples.shade(sky.view(), settings);
  for (std::size_t i = 4; i < rgba.size(); i += 4) {
    EXPECT_NEAR(rgba[i + 1] / rgba[1], 1.0F, 1e-4F);
  }
  const Vector3<float> seen = tristimulus_of(Vector3<float>{rgba[0], rgba[1], rgba[2]});
  const double sum = static_cast<double>(seen.x + seen.y + seen.z);
  return {static_cast<double>(seen.y), static_cast<double>(seen.x) / sum, static_cast<double>(seen.y) / sum};
}

TEST(BlackbodyFit, SkyOfABlackbodyIsOneOfTheShiftedTemperature) {
  for (const SkyFilter filter : {SkyFilter::ewa, SkyFilter::point, SkyFilter::polygon}) {
    for (const double g : {0.4, 0.7, 1.0, 1.3, 2.5}) {
      const Blackened seen = seen_of_blackbody(5800.0, g, filter);
      const Vector3<double> exact = blackbody_tristimulus(5800.0 * g);
      const double sum = exact.x + exact.y + exact.z;
      EXPECT_NEAR(seen.luminance_ratio / (exact.y / blackbody_tristimulus(5800.0).y), 1.0, 5e-3) << g;
      EXPECT_NEAR(seen.x / (exact.x / sum), 1.0, 5e-3) << g;
      EXPECT_NEAR(seen.y / (exact.y / sum), 1.0, 5e-3) << g;
    }
  }
}

TEST(BlackbodyFit, DarkTexelsDoNotDecideTheTemperature) {
  // A sky with warm bright parts and blue parts that are much fainter. The filtered light must have
  // the temperature of the bright parts.
  const BlackbodyColours colours(Backend::cpu);
  const TemperatureFit fit(colours.view());
  const SkyCube sky(
      Backend::cpu, 64,
      [](const glm::dvec3& d) {
        return std::sin(60.0 * d.x) > 0.0 ? glm::vec3(1.0F, 0.6F, 0.3F) : 1e-4F * glm::vec3(0.3F, 0.6F, 1.0F);
      },
      &fit);
  const Quad mean = cube_mean_texel(sky.view());
  const float luminance = luminance_of(Vector3<float>{quad_part(mean, 0), quad_part(mean, 1), quad_part(mean, 2)});
  EXPECT_NEAR(log_reference_temperature + quad_part(mean, 3) / luminance, fit.log_temperature({1.0F, 0.6F, 0.3F}),
              0.01F);
}

TEST(BlackbodyFit, DarkLightDoesNotBecomeBright) {
  // Beside a bright texel, the dark ones have such small numbers that light and temperature are
  // rounded coarsely, each by itself.
  const BlackbodyColours colours(Backend::cpu);
  const TemperatureFit fit(colours.view());
  for (const float dark : {2.5e-12F, 4e-12F, 7e-12F, 3e-11F}) {
    const SkyCube sky(
        Backend::cpu, 16,
        [&](const glm::dvec3& d) {
          return d.z > 0.98 ? glm::vec3(1.0F) : dark * glm::vec3(1.0F + d.x, 0.5F * (1.0F + d.y), 0.4F);
        },
        &fit);
    PictureSettings settings;
    settings.filter = SkyFilter::point;
    settings.shift = SkyShift::blackbody_fit;
    settings.colours = colours.view();
    const std::vector<Vector3<float>> directions = directions_everywhere(2000);
    SkySamples samples(directions, 1.5F);
    const std::vector<float>& rgba = samples.shade(sky.view(), settings);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (directions[i].z < 0.5F) {
        EXPECT_LT(std::max({rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]}), 1e4F * dark);
      }
    }
  }
}

TEST(LuminanceShift, GoesWithTheFourthPowerAndLeavesColours) {
  const SkyCube sky(Backend::cpu, 16, [](const glm::dvec3& d) { return glm::vec3(1.0 + d.x, 0.7, 0.1); });
  for (const float g : {0.5F, 1.0F, 1.7F}) {
    SkySamples samples(directions_everywhere(40), g);
    PictureSettings settings;
    const std::vector<float> plain = samples.shade(sky.view(), settings);
    settings.shift = SkyShift::luminance;
    const std::vector<float> shifted = samples.shade(sky.view(), settings);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_NEAR(shifted[i], i % 4 == 3 ? plain[i] : plain[i] * std::pow(g, 4.0F), 1e-5F);
    }
  }
}

TEST(ShowSky, EveryLookAtTheSkyGivesAPicture) {
  for (const std::string look : {"filter = \"ewa\"\nshift = \"luminance\"\nbrightening = true\n",
                                 "filter = \"point\"\nshift = \"blackbody_fit\"\n",
                                 "filter = \"polygon\"\nshift = \"blackbody_fit\"\nbrightening = true\n"}) {
    const Picture picture =
        ShowRenderer(dome_show(look, "[effects]\nredshift = true\n"), Backend::cpu).render(0.0, {}).front().picture;
    double sum = 0.0;
    for (const float value : picture.rgba) {
      ASSERT_TRUE(std::isfinite(value) && value >= -1e-5F) << look;
      sum += static_cast<double>(value);
    }
    EXPECT_GT(sum, 1000.0) << look;
  }
}

TEST(ShowSky, FiltersAgreeOnWhatAPictureShowsOnTheWhole) {
  const auto mean_light = [](const std::string& filter) {
    const Picture picture =
        ShowRenderer(dome_show("filter = \"" + filter + "\"\n"), Backend::cpu).render(0.0, {}).front().picture;
    double sum = 0.0;
    for (std::size_t i = 1; i < picture.rgba.size(); i += 4) {
      sum += static_cast<double>(picture.rgba[i]);
    }
    return sum;
  };
  const double ewa = mean_light("ewa");
  EXPECT_NEAR(mean_light("polygon") / ewa, 1.0, 0.02);
  EXPECT_NEAR(mean_light("point") / ewa, 1.0, 0.05);
}

}  // namespace
}  // namespace ergodome
