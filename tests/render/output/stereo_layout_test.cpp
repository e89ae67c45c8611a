#include "render/output/stereo_layout.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <gtest/gtest.h>

#include "render/output/image_writer.h"
#include "render/output/tone_map.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

//! Returns a picture whose value at (x, y, channel) encodes the position and the eye.
Picture marked(int width, int height, float eye) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) {
        picture.rgba.push_back(eye + 0.01F * static_cast<float>(x) + 0.001F * static_cast<float>(y) +
                               0.0001F * static_cast<float>(c));
      }
    }
  }
  return picture;
}

Picture plain(float red, float green, float blue) {
  Picture picture;
  picture.width = 2;
  picture.height = 2;
  const float colour[4] = {red, green, blue, 1.0F};
  for (std::size_t i = 0; i < 16; ++i) {
    picture.rgba.push_back(colour[i % 4]);
  }
  return picture;
}

float at(const Picture& picture, int x, int y, int channel = 0) {
  return picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + static_cast<std::size_t>(channel)];
}

TEST(StereoLayouts, HaveTheSizeThatTheySay) {
  const Picture left = marked(7, 5, 0.1F);
  for (std::size_t i = 0; i < stereo_layout_names.size(); ++i) {
    const auto layout = static_cast<StereoLayout>(i);
    if (keeps_eyes_apart(layout)) {
      continue;
    }
    const Picture joined = joined_eyes(left, left, layout);
    const ImageSize size = layout_size(layout, {7, 5});
    EXPECT_EQ(joined.width, size.width) << stereo_layout_names[i];
    EXPECT_EQ(joined.height, size.height) << stereo_layout_names[i];
    EXPECT_EQ(joined.rgba.size(), 4U * static_cast<std::size_t>(size.width * size.height));
  }
}

TEST(StereoLayouts, SayHowEyesShareAWindow) {
  for (std::size_t i = 0; i < stereo_layout_names.size(); ++i) {
    const auto layout = static_cast<StereoLayout>(i);
    const ImageSize size = window_picture_size(layout, {8, 6});
    const EyeGrid grid = eye_grid(layout);
    EXPECT_DOUBLE_EQ(size.width, grid.columns * grid.across * 8) << stereo_layout_names[i];
    EXPECT_DOUBLE_EQ(size.height, grid.rows * grid.along * 6) << stereo_layout_names[i];
  }
  EXPECT_EQ(eye_grid(StereoLayout::separate), eye_grid(StereoLayout::side_by_side));
  EXPECT_EQ(eye_grid(StereoLayout::rows), EyeGrid{});
}

TEST(StereoLayouts, HalvesAreMeansOfTwoPixels) {
  const Picture left = marked(4, 4, 0.1F);
  const Picture right = marked(4, 4, 0.5F);
  const Picture across = joined_eyes(left, right, StereoLayout::half_side_by_side);
  EXPECT_FLOAT_EQ(at(across, 1, 2), 0.5F * (at(left, 2, 2) + at(left, 3, 2)));
  EXPECT_FLOAT_EQ(at(across, 2, 3), 0.5F * (at(right, 0, 3) + at(right, 1, 3)));
  const Picture down = joined_eyes(left, right, StereoLayout::half_top_bottom);
  EXPECT_FLOAT_EQ(at(down, 3, 0), 0.5F * (at(left, 3, 0) + at(left, 3, 1)));
  EXPECT_FLOAT_EQ(at(down, 1, 3), 0.5F * (at(right, 1, 2) + at(right, 1, 3)));
}

TEST(StereoLayouts, AnOddEndIsAPixelOfItsOwn) {
  const Picture left = marked(3, 1, 0.1F);
  const Picture across = joined_eyes(left, left, StereoLayout::half_side_by_side);
  EXPECT_FLOAT_EQ(at(across, 1, 0), at(left, 2, 0));
}

TEST(StereoLayouts, RowsTakeTurnsAndTheLeftEyeBegins) {
  const Picture left = marked(2, 5, 0.1F);
  const Picture right = marked(2, 5, 0.5F);
  const Picture rows = joined_eyes(left, right, StereoLayout::rows);
  for (int y = 0; y < 5; ++y) {
    EXPECT_EQ(at(rows, 1, y), at(y % 2 == 0 ? left : right, 1, y)) << y;
  }
}

TEST(StereoLayouts, AnaglyphGivesRedToTheLeftEyesLuminance) {
  const Picture mixed = joined_eyes(plain(0.1F, 0.5F, 0.2F), plain(0.7F, 0.3F, 0.4F), StereoLayout::anaglyph);
  EXPECT_FLOAT_EQ(at(mixed, 0, 0, 0), 0.2126F * 0.1F + 0.7152F * 0.5F + 0.0722F * 0.2F);
  EXPECT_FLOAT_EQ(at(mixed, 0, 0, 1), 0.3F);
  EXPECT_FLOAT_EQ(at(mixed, 0, 0, 2), 0.4F);
}

TEST(StereoLayouts, DuboisKeepsWhiteAndGivesEachEyeItsOwn) {
  const Picture white = plain(1.0F, 1.0F, 1.0F);
  const Picture black = plain(0.0F, 0.0F, 0.0F);
  const auto mixed = [](Picture left, Picture right) {
    // The shoulder curve would change a display light of 1.
    left.tone = right.tone = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
    return joined_eyes(left, right, StereoLayout::dubois);
  };
  const Picture both = mixed(white, white);
  const Picture left = mixed(white, black);
  const Picture right = mixed(black, white);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(at(both, 0, 0, c), 1.0F, 0.01F) << c;
    EXPECT_EQ(at(left, 0, 0, c) > 0.5F, c == 0) << c;
    EXPECT_EQ(at(right, 0, 0, c) > 0.5F, c != 0) << c;
  }
}

TEST(StereoLayouts, AnaglyphsAreMixedOfLightAsItIsShown) {
  Picture bright = plain(3.0F, 3.0F, 3.0F);
  bright.tone = {ToneCurve::reinhard, 0.5F, 4.0F, 2.2F};
  const Picture mixed = joined_eyes(bright, bright, StereoLayout::anaglyph);
  EXPECT_EQ(tone_mapped(mixed)[1], tone_mapped(bright)[1]);
}

TEST(StereoLayouts, TintsTellTheEyesApart) {
  Picture left = plain(0.5F, 0.5F, 0.5F);
  Picture right = left;
  tint_left_eye(left);
  tint_right_eye(right);
  EXPECT_GT(at(left, 0, 0, 0), 2.0F * at(left, 0, 0, 2));
  EXPECT_GT(at(right, 0, 0, 2), 2.0F * at(right, 0, 0, 0));
}

class MultiView : public test::FolderTest {};

TEST_F(MultiView, OpenExrFindsBothViewsByName) {
  const Picture pictures[] = {marked(6, 4, 0.1F), marked(6, 4, 0.5F)};
  const std::string path = (folder_ / "views.exr").string();
  write_views(path, {ImageFormat::exr}, pictures[0], pictures[1], {{"spin", "0.9"}});
  Imf::MultiPartInputFile file(path.c_str());
  ASSERT_EQ(file.parts(), 2);
  for (int part = 0; part < 2; ++part) {
    const Imf::Header& header = file.header(part);
    ASSERT_TRUE(header.hasView());
    EXPECT_EQ(header.view(), part == 0 ? "left" : "right");
    EXPECT_EQ(header.name(), part == 0 ? "left" : "right");
    ASSERT_NE(header.channels().findChannel("R"), nullptr);
    Imf::Array2D<float> green(4, 6);
    Imf::FrameBuffer buffer;
    buffer.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&green[0][0]), sizeof(float), 6 * sizeof(float)));
    Imf::InputPart input(file, part);
    input.setFrameBuffer(buffer);
    input.readPixels(0, 3);
    EXPECT_NEAR(green[3][5], at(pictures[part], 5, 3, 1), 1e-3F);
  }
  EXPECT_TRUE(is_complete_image(path, 6, 4, 2));
}

}  // namespace
}  // namespace ergodome
