#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "kernels/launch/cuda.h"
#include "kernels/launch/launch.h"
#include "render/frame/show_renderer.h"
#include "render/output/stereo_layout.h"
#include "tests/support/tiny_sky.h"

// Compares pictures of the GPU with those of the CPU. Kernels have a single source for both, but
// are compiled by two compilers, and the code that copies buffers to the GPU may have forgotten
// one.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): skies of tests

//! A scene and how it is rendered.
struct Scene {
  std::string name;
  std::string show;  //!< name of a built-in show
  ViewMode mode = ViewMode::sky;
  LensChoice lens = LensChoice::direct;
  std::function<void(Show&)> change = [](Show&) {};
  double part = 0.31;  //!< time of the picture, as a fraction of the show's duration
};

std::ostream& operator<<(std::ostream& stream, const Scene& scene) { return stream << scene.name; }

Show show_of(const Scene& scene) {
  Show show = read_show(built_in_content_folder() / "shows" / (scene.show + ".toml"));
  show.sky.map = tiny_sky();
  scene.change(show);
  return show;
}

std::vector<Picture> pictures(const Scene& scene, Backend backend) {
  const Show show = show_of(scene);
  ShowRenderer renderer(show, backend, scene.lens);
  std::vector<Picture> made;
  for (FrameImage& image : renderer.render(scene.part * std::max(show.duration_s, 1.0), {scene.mode, 384})) {
    made.push_back(std::move(image.picture));
  }
  return made;
}

//! The difference between two pictures: the fraction of numbers that differ visibly, and the
//! relative difference of the total light.
struct Difference {
  //! Fraction of the numbers that differ by more than 2 % of their value and of the mean.
  double pixels;
  double light;  //!< relative difference of the total light
};

Difference difference(const Picture& a, const Picture& b) {
  double sum = 0.0;
  double apart = 0.0;
  long pixels = 0;
  const auto each = [&](const auto& body) {
    for (std::size_t i = 0; i < b.rgba.size(); ++i) {
      if (i % 4 != 3) {
        body(static_cast<double>(a.rgba[i]), static_cast<double>(b.rgba[i]));
      }
    }
  };
  each([&](double, double there) { sum += std::abs(there); });
  const double count = 0.75 * static_cast<double>(b.rgba.size());
  each([&](double here, double there) {
    const double error = std::abs(here - there);
    apart += std::isnan(error) ? 1e30 : error;
    pixels += error <= 0.02 * (std::abs(there) + sum / count) ? 0 : 1;
  });
  return {static_cast<double>(pixels) / count, apart / sum};
}

class CudaPictures : public testing::TestWithParam<Scene> {
 protected:
  void SetUp() override {
    if (const char* const reason = cuda_unavailable_reason()) {
      GTEST_SKIP() << reason;
    }
  }
};

TEST_P(CudaPictures, AreThoseOfTheProcessor) {
  const std::vector<Picture> there = pictures(GetParam(), Backend::cuda);
  const std::vector<Picture> here = pictures(GetParam(), Backend::cpu);
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(there[i].rgba.size(), here[i].rgba.size());
    ASSERT_GT(*std::ranges::max_element(here[i].rgba), 0.0F) << "the picture is black";
    const Difference seen = difference(there[i], here[i]);
    // Next to the edge of the shadow, a rounding error moves the sky by more than a pixel.
    EXPECT_LT(seen.pixels, 0.005);
    EXPECT_LT(seen.light, 0.002);
    EXPECT_NEAR(static_cast<double>(there[i].unresolved_pixels), static_cast<double>(here[i].unresolved_pixels), 2.0);
  }
}

TEST_P(CudaPictures, AreTheSameAgainToTheLastBit) {
  const std::vector<Picture> once = pictures(GetParam(), Backend::cuda);
  const std::vector<Picture> again = pictures(GetParam(), Backend::cuda);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(once[i].rgba, again[i].rgba));
  }
}

TEST_P(CudaPictures, AreThoseThatStayOnTheDevice) {
  const Show show = show_of(GetParam());
  ShowRenderer renderer(show, Backend::cuda, GetParam().lens);
  if (!renderer.may_stay_in_place(GetParam().mode)) {
    GTEST_SKIP() << "pictures of this scene come home";
  }
  const double time_s = 0.31 * std::max(show.duration_s, 1.0);
  renderer.apply(time_s);
  const CameraPose pose = camera_pose(renderer.show(), time_s);
  const Projection projection = make_projection(show.view, 384, 0.0);
  const std::vector<Picture> expected = renderer.render_window_parts(pose, projection, GetParam().mode, {time_s});
  const BackendEyes made = renderer.render_eyes_in_place(pose, projection, GetParam().mode, {time_s});
  ASSERT_EQ(expected.size(), made.right ? 2U : 1U);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    Picture there = copied_picture(expected[i]);
    copy_from_cuda(there.rgba.data(), i == 0 ? made.first.rgba : made.right->rgba, there.rgba.size() * sizeof(float));
    EXPECT_LT(difference(there, expected[i]).light, 1e-6);
  }
}

Scene by_grid(Scene scene) {
  scene.name += "_by_grid";
  scene.lens = LensChoice::live;
  return scene;
}

std::vector<Scene> scenes() {
  const auto two_eyes = [](StereoModel model) {
    return [model](Show& show) {
      show.stereo.layout = StereoLayout::separate;
      show.stereo.model = model;
      show.stereo.baseline = 0.3;
    };
  };
  std::vector<Scene> all = {
      {"dome", "dome-still"},
      {"path", "first-light"},
      {"within_the_horizon", "through", ViewMode::sky, LensChoice::direct, [](Show&) {}, 0.8},
      {"whole_sky", "grid-sky"},
      {"edge", "prograde-edge"},
      {"stars", "star-field"},
      {"stars_alone", "star-field", ViewMode::sky, LensChoice::direct, [](Show& show) { show.sky.map = "black"; }},
      {"spikes", "star-field", ViewMode::sky, LensChoice::direct,
       [](Show& show) {
         show.sky.map = "black";
         show.effects.diffraction = DiffractionSettings{};
       }},
      {"trails", "star-trails"},
      {"effects", "published-effects", ViewMode::sky, LensChoice::direct,
       [](Show& show) {
         show.sky.stars = "bright_stars";
         show.sky.shift = SkyShift::blackbody_fit;
         show.sky.brightening = true;
         show.effects.redshift = true;
         show.effects.magnification = true;
         show.effects.psf = PointSpreadSettings{};
         show.effects.diffraction = DiffractionSettings{};
         show.effects.bloom = BloomSettings{};
       }},
      {"point", "dome-still", ViewMode::sky, LensChoice::direct,
       [](Show& show) { show.sky.filter = SkyFilter::point; }},
      {"polygon", "dome-still", ViewMode::sky, LensChoice::direct,
       [](Show& show) { show.sky.filter = SkyFilter::polygon; }},
      {"disk", "disk"},
      {"plain_disk", "disk", ViewMode::sky, LensChoice::direct,
       [](Show& show) { show.disk->pattern = DiskPattern::none; }},
      {"shells", "shells"},
      {"disk_and_shells", "disk", ViewMode::sky, LensChoice::direct,
       [](Show& show) {
         show.shells.emplace_back();
         show.shells[0].radius = 25.0;
       }},
      {"planet", "planet"},
      {"two_eyes", "dome-still", ViewMode::sky, LensChoice::direct,
       [](Show& show) {
         show.stereo.layout = StereoLayout::side_by_side;
         show.stereo.baseline = 0.3;
         show.stereo.swap_eyes = true;
       }},
      {"omni_eyes", "dome-still", ViewMode::sky, LensChoice::direct, two_eyes(StereoModel::omni)},
      {"omni_eyes_before_a_disk", "disk", ViewMode::sky, LensChoice::direct, two_eyes(StereoModel::omni)},
      {"flat_eyes", "dome-still", ViewMode::sky, LensChoice::direct, two_eyes(StereoModel::flat)},
      {"flat_eyes_before_a_disk", "disk", ViewMode::sky, LensChoice::direct, two_eyes(StereoModel::flat)},
      {"flat_eyes_before_shells", "shells", ViewMode::sky, LensChoice::direct, two_eyes(StereoModel::flat)},
      {"flat_eyes_before_a_planet", "planet", ViewMode::sky, LensChoice::direct, two_eyes(StereoModel::flat)},
      {"flat_eyes_before_a_planet_alone", "planet", ViewMode::sky, LensChoice::direct,
       [two_eyes](Show& show) {
         two_eyes(StereoModel::flat)(show);
         show.disk.reset();
         show.shells.clear();
       }},
      {"steps", "dome-still", ViewMode::steps},
      {"steps_with_shells", "shells", ViewMode::steps},
      {"image_order", "dome-still", ViewMode::image_order},
      {"frequency_ratio", "dome-still", ViewMode::frequency_ratio},
      {"magnification", "dome-still", ViewMode::magnification},
  };
  for (const char* name : {"dome", "path", "within_the_horizon", "whole_sky", "edge", "disk", "flat_eyes"}) {
    all.push_back(by_grid(*std::ranges::find(all, name, &Scene::name)));
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Of, CudaPictures, testing::ValuesIn(scenes()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace ergodome
