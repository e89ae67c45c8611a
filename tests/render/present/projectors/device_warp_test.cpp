#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "kernels/image/light_texels_kernel.h"
#include "kernels/image/warp_pixel_kernel.h"
#include "render/present/projectors/software_projectors.h"
#include "tests/render/curved_projector.h"
#include "tests/render/present/projectors/projector_frames.h"
#include "tests/render/present/projectors/projector_light.h"

// Runs the GPU code for projector pictures on the CPU. Compares its results with those of the CPU
// code and with the formula.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): projectors of tests

constexpr ToneCurve curves[] = {ToneCurve::shoulder, ToneCurve::reinhard, ToneCurve::filmic, ToneCurve::gamma};

void run_all(const auto& functor, int count) {
  for (int i = 0; i < count; ++i) {
    functor(i);
  }
}

//! A level of a picture's mip chain. Its memory is filled with -1, so that values that are not
//! computed remain visible.
struct Level {
  std::vector<float> rgba;
  LightLevel view;

  Level(int width, int height)
      : rgba(4 * (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + 1), -1.0F),
        view{rgba.data(), width, height} {}
};

//! Expects that the colors of two levels are equal up to rounding, in computed tiles and in those
//! that were skipped. Ignores the fourth channel.
void expect_alike(const Level& a, const Level& b) {
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_NEAR(a.rgba[i], b.rgba[i], 2e-6F) << i;
    }
  }
}

std::vector<std::int32_t> tiles_of(std::initializer_list<std::int32_t> numbers) { return numbers; }

TEST(DeviceLight, IsTonedAsTheProcessorTonesIt) {
  // The picture consists of three by two tiles, the last of which are narrower. Two tiles are
  // skipped.
  Picture master = master_of(150, soft_colours);
  master.height = 100;
  master.rgba[40] = std::numeric_limits<float>::quiet_NaN();
  master.rgba[44] = std::numeric_limits<float>::infinity();
  master.rgba[48] = -3.0F;
  const std::vector<std::int32_t> tiles = tiles_of({0, 2, 3, 5});
  for (const ToneCurve curve : curves) {
    for (const bool heat_map : {false, true}) {
      Level by_texels(150, 100);
      Level by_tiles(150, 100);
      ToneBatch batch = {master.rgba.data(), by_texels.view, {curve, 1.5F, 3.0F, 2.2F}, heat_map, tiles.data(), 4};
      run_all(ToneTexels{batch}, 4 * light_tile_texels);
      batch.to = by_tiles.view;
      launch(Backend::cpu, batch);
      expect_alike(by_texels, by_tiles);
      EXPECT_EQ(by_texels.rgba[4 * 70], -1.0F);
      EXPECT_GT(by_texels.rgba[4 * 149], 0.0F);
    }
  }
}

TEST(DeviceLight, IsAveragedAsTheProcessorAveragesIt) {
  const Picture master = master_of(301, soft_colours);
  Level finer(301, 301);
  std::copy(master.rgba.begin(), master.rgba.end(), finer.rgba.begin());
  Level by_texels(150, 150);
  Level by_tiles(150, 150);
  const std::vector<std::int32_t> tiles = tiles_of({0, 4, 5, 8});
  run_all(AverageTexels{{finer.view, by_texels.view, tiles.data(), 4}}, 4 * light_tile_texels);
  launch(Backend::cpu, AverageBatch{finer.view, by_tiles.view, tiles.data(), 4});
  expect_alike(by_texels, by_tiles);
  EXPECT_GT(by_texels.rgba[4 * (150 * 149 + 149)], 0.0F);
}

//! Returns the frame of a projector, computed pixel by pixel.
std::vector<std::uint8_t> frame_by_pixels(const ProjectorPicture& picture, const Picture& master) {
  const ProjectorWarp warp(picture, master.width, master.height, Backend::cpu);
  LightTiles tiles = warp.tiles();
  tiles.complete();
  MasterLight light(tiles, Backend::cpu);
  light.update(master_picture(master));
  const int pixels = picture.width_px * picture.height_px;
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(pixels));
  const WarpBatch batch = warp.batch(light.levels(), 1.0F, rgb.data());
  if (batch.coloured) {
    run_all(WarpPixel<true>{batch}, pixels);
  } else {
    run_all(WarpPixel<false>{batch}, pixels);
  }
  return rgb;
}

TEST(DeviceWarp, IsTheProcessors) {
  std::size_t all = 0;
  std::size_t different = 0;
  for (const ProjectorPicture& picture : {curved_picture(), grey_picture(), plain_picture()}) {
    for (const int size : {1, 33, 64, 301, 1024}) {
      Picture master = master_of(size, soft_colours);
      master.tone.curve = ToneCurve::reinhard;
      SoftwareProjectors processor({picture});
      processor.show(master);
      const auto expected = processor.frame(0);
      const auto found = frame_by_pixels(picture, master);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_NEAR(found[i], expected[i], 1) << size << " px, byte " << i;
        different += found[i] != expected[i] ? 1 : 0;
      }
      all += found.size();
    }
  }
  // Few values differ by one, because they were rounded differently.
  EXPECT_LT(different, all / 1000);
}

//! The input for a projector with a single group of pixels, all of which read the same texel.
struct OneGroup {
  float texel[8];
  WarpGroup group = {0.0F, 0.0F, 0.0F, 0.0F, 1, 0};
  std::uint16_t positions[warp_group_px] = {};
  std::uint8_t levels[warp_group_px] = {};
  std::uint16_t factors[warp_group_px] = {};
  std::uint8_t rgb[3 * warp_group_px] = {};
  WarpBatch batch{};

  explicit OneGroup(float light) : texel{light, light, light, 1.0F} {
    batch.light = {{{texel, 1, 1}}, 1};
    batch.width_px = warp_group_px;
    batch.height_px = 1;
    batch.groups = &group;
    batch.x = positions;
    batch.y = positions;
    batch.level = levels;
    batch.factor = factors;
    batch.rgb = rgb;
  }
};

TEST(DeviceWarp, IsWhatTheFormulaSays) {
  for (const float light : {0.0F, 1e-5F, 0.03F, 0.4F, 1.0F}) {
    for (const float gamma : {0.6F, 1.0F, 1.9F, 2.4F}) {
      const ProjectorColour colour = {1.0F, 0.015F, 1.2F, gamma};
      OneGroup one(light);
      for (int i = 0; i < warp_group_px; ++i) {
        one.factors[i] = static_cast<std::uint16_t>(4369 * i);
      }
      for (int c = 0; c < 3; ++c) {
        one.batch.factor_scale[c] = colour.gain * (1.0F - colour.lift) / (65535.0F * 65535.0F);
        one.batch.lift_scale[c] = colour.gain * colour.lift;
      }
      one.batch.exponent = 1.0F / gamma;
      one.batch.minimum = std::exp2(-100.0F / std::max(1.0F / gamma, 1.0F));
      run_all(WarpPixel<false>{one.batch}, warp_group_px);
      for (int i = 0; i < warp_group_px; ++i) {
        ProjectorColour here = colour;
        here.factor = static_cast<float>(i * i) / 225.0F;
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(one.rgb[3 * i + c], 255.0F * projector_value(here, light), 0.52F) << light << " " << gamma;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
