#include "render/present/projectors/projector_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/warps/warp_conversion.h"
#include "tests/render/curved_projector.h"
#include "tests/render/present/projectors/projector_frames.h"
#include "tests/render/present/projectors/projector_light.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): projectors and domes of tests

//! Interpolates a channel of a mask linearly at a position.
float mask_at(const BlendMap& mask, double x, double y, int channel) {
  const double column = std::clamp(x * mask.width - 0.5, 0.0, mask.width - 1.0);
  const double row = std::clamp(y * mask.height - 0.5, 0.0, mask.height - 1.0);
  const int left = std::min(static_cast<int>(column), mask.width - 2);
  const int top = std::min(static_cast<int>(row), mask.height - 2);
  const auto at = [&](int i, int j) {
    const int one = mask.channels == 1 ? 0 : channel;
    const int value = mask.channels * (j * mask.width + i) + one;
    return static_cast<double>(mask.values[static_cast<std::size_t>(value)]);
  };
  return static_cast<float>(std::lerp(std::lerp(at(left, top), at(left + 1, top), column - left),
                                      std::lerp(at(left, top + 1), at(left + 1, top + 1), column - left), row - top));
}

TEST_P(ProjectorFrames, AreWhatTheFormulaSays) {
  const ProjectorPicture picture = curved_picture();
  ASSERT_NO_FATAL_FAILURE(open({picture}));
  if (!projectors_) {
    return;
  }
  Picture master = master_of(64, soft_colours);
  master.tone = {ToneCurve::reinhard, 1.5F, 3.0F, 2.2F};
  projectors_->show(master);
  const auto shown = projectors_->frame(0);
  const WarpMesh warp = resampled_warp(picture.warp, picture.width_px, picture.height_px);
  int wrong = 0;
  int drawn = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const WarpNode& node = warp.at(x, y);
      const double across = fill_position(x, picture.width_px);
      const double down = fill_position(y, picture.height_px);
      drawn += node.valid ? 1 : 0;
      for (int c = 0; c < 3; ++c) {
        const float light =
            node.valid ? std::min(toned(master.tone, channel_of(soft_colours(node.u, node.v), c)), 1.0F) : 0.0F;
        const double lift = c == 0 ? 0.02 : c == 1 ? 0.05 : 0.01;
        const ProjectorColour colour = {node.intensity * mask_at(picture.blend, across, down, c),
                                        static_cast<float>(lift) * mask_at(picture.black_level, across, down, c),
                                        c == 0   ? 1.0F
                                        : c == 1 ? 0.9F
                                                 : 1.3F,
                                        1.9F};
        const double expected = 255.0 * projector_value(colour, light);
        const int index = 3 * (y * picture.width_px + x) + c;
        const int byte = shown[static_cast<std::size_t>(index)];
        wrong += std::abs(byte - expected) > 2.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(drawn, 3500);
  // Masks are read at the positions of the warp. These differ from the positions of pixels if nodes
  // are off the regular lattice. Pixels on the rims of the hole and of the mesh may be on either
  // side.
  EXPECT_LT(wrong, 3 * 60);
}

TEST_P(ProjectorFrames, LiftBlacksWhereNothingIsDrawn) {
  ProjectorPicture picture = curved_picture();
  picture.black_level = {};
  picture.gain = {1.0, 1.0, 1.0};
  for (WarpNode& node : picture.warp.nodes) {
    node.x = 0.5F * node.x;
  }
  ASSERT_NO_FATAL_FAILURE(open({picture}));
  if (!projectors_) {
    return;
  }
  projectors_->show(master_of(16, soft_colours));
  const auto shown = projectors_->frame(0);
  const std::size_t right = 3 * static_cast<std::size_t>(30 * picture.width_px + 80);
  EXPECT_NEAR(shown[right], 255.0 * std::pow(0.02, 1.0 / 1.9), 1.0);
  EXPECT_NEAR(shown[right + 1], 255.0 * std::pow(0.05, 1.0 / 1.9), 1.0);
}

TEST_P(ProjectorFrames, CornersTakeThePictureAlong) {
  ProjectorPicture picture = curved_picture();
  picture.warp = {};
  picture.warp.columns = 2;
  picture.warp.rows = 2;
  picture.warp.nodes = {{0, 0, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}, {1, 1, 1, 1}};
  picture.black_level_lift = {};
  picture.offsets.right = {0.1, 0.1, 0.1, 0.1};
  ASSERT_NO_FATAL_FAILURE(open({picture}));
  if (!projectors_) {
    return;
  }
  projectors_->show(master_of(64, [](double, double) { return Vector3<float>{0.5F, 0.5F, 0.5F}; }));
  const auto shown = projectors_->frame(0);
  const auto red = [&](int x) { return shown[3 * static_cast<std::size_t>(30 * picture.width_px + x)]; };
  EXPECT_EQ(red(8), 0);
  EXPECT_GT(red(9), 60);
  EXPECT_GT(red(89), 60);
}

TEST_P(ProjectorFrames, WhatIsDrawnSmallIsAveraged) {
  // The master has fine stripes, fifteen of its pixels per projector pixel. They must be averaged
  // to gray, without a moiré pattern.
  ProjectorPicture picture = curved_picture();
  picture.warp = {};
  picture.warp.columns = 2;
  picture.warp.rows = 2;
  picture.warp.nodes = {{0, 0, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}, {1, 1, 1, 1}};
  picture.blend = {};
  picture.black_level_lift = {};
  picture.gain = {1.0, 1.0, 1.0};
  ASSERT_NO_FATAL_FAILURE(open({picture}));
  if (!projectors_) {
    return;
  }
  const int size = 1024;
  Picture master = master_of(size, [](double u, double) {
    const float light = static_cast<int>(u * size) % 2 == 0 ? 0.0F : 0.8F;
    return Vector3<float>{light, light, light};
  });
  projectors_->show(master);
  const auto shown = projectors_->frame(0);
  const double expected = 255.0 * std::pow(0.4, 1.0 / 1.9);
  for (int x = 5; x < 85; ++x) {
    EXPECT_NEAR(shown[3 * static_cast<std::size_t>(30 * picture.width_px + x)], expected, 4.0) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(By, ProjectorFrames, testing::ValuesIn(drawers), name_of_drawer);

//! The difference between two frames of a projector.
struct FrameDifference {
  int largest = 0;
  std::size_t beyond_one = 0;
};

FrameDifference difference_of(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  FrameDifference found;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int off = std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
    found.largest = std::max(found.largest, off);
    found.beyond_one += off > 1 ? 1 : 0;
  }
  return found;
}

//! Draws a projector's frame by OpenGL and by the CPU, and compares the results.
FrameDifference between_drawers(const ProjectorPicture& picture, const Picture& master) {
  HeadlessProjectors opengl({picture}, ProjectorDrawer::opengl);
  HeadlessProjectors processor({picture}, ProjectorDrawer::processor);
  opengl.show(master);
  processor.show(master);
  return difference_of(opengl.frame(0), processor.frame(0));
}

TEST(ProjectorDrawers, DifferInTheLastBitAlone) {
  driver_was_loaded = true;
  try {
    const HeadlessProjectors there({curved_picture()}, ProjectorDrawer::opengl);
  } catch (const Error& problem) {
    GTEST_SKIP() << problem.what();
  }
  for (const ToneCurve curve : {ToneCurve::shoulder, ToneCurve::reinhard, ToneCurve::filmic, ToneCurve::gamma}) {
    for (const ProjectorPicture& picture : {curved_picture(), grey_picture(), plain_picture()}) {
      // Sizes of the master that are larger and smaller than the raster, some of them odd.
      for (const int size : {33, 64, 301}) {
        // Under sanitizers, one of the curves is enough to cover the same code.
        if (sanitized && size != 33 && curve != ToneCurve::shoulder) {
          continue;
        }
        Picture master = master_of(size, soft_colours);
        master.tone = {curve, 1.5F, 3.0F, 2.2F};
        const FrameDifference found = between_drawers(picture, master);
        // Pixels on the rims of the hole and of the mesh may be on either side.
        EXPECT_LT(found.beyond_one, 3U * 8U) << size << " px, largest " << found.largest;
      }
    }
  }
}

TEST(ProcessorFrames, ReadMastersOfOnePixel) {
  ProjectorPicture picture = curved_picture();
  HeadlessProjectors projectors({picture}, ProjectorDrawer::processor);
  const Picture white = master_of(1, [](double, double) { return Vector3<float>{0.5F, 0.5F, 0.5F}; });
  const Picture larger = master_of(64, [](double, double) { return Vector3<float>{0.5F, 0.5F, 0.5F}; });
  projectors.show(white);
  const auto one = projectors.frame(0);
  projectors.show(larger);
  EXPECT_EQ(difference_of(one, projectors.frame(0)).largest, 0);
}

TEST(ProcessorFrames, WhatIsNoNumberIsBlack) {
  ProjectorPicture picture = curved_picture();
  picture.black_level_lift = {};
  HeadlessProjectors projectors({picture}, ProjectorDrawer::processor);
  projectors.show(master_of(64, [](double, double) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    return Vector3<float>{none, -1.0F, none};
  }));
  const auto shown = projectors.frame(0);
  EXPECT_EQ(*std::ranges::max_element(shown), 0);
}

TEST(ProcessorFrames, AreDimmedAsTheMasterIs) {
  const Picture bright = master_of(64, [](double u, double v) {
    return Vector3<float>{static_cast<float>(0.7 * u), static_cast<float>(0.6 * v), 0.4F};
  });
  Picture half = bright;
  for (float& value : half.rgba) {
    value *= 0.5F;
  }
  // set_light() does not change the lift of the black level.
  for (const ProjectorPicture& picture : {curved_picture(), grey_picture()}) {
    SoftwareProjectors projectors({picture});
    projectors.show(half);
    const auto expected = projectors.frame(0);
    projectors.show(bright);
    projectors.set_light(0.5F);
    EXPECT_LE(difference_of(projectors.frame(0), expected).largest, 1);
  }
}

}  // namespace
}  // namespace ergodome
