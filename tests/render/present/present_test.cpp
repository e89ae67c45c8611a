#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "kernels/core/error.h"
#include "render/opengl/headless_context.h"
#include "render/output/stereo_layout.h"
#include "render/output/tone_map.h"
#include "render/present/caption_texture.h"
#include "render/present/presenter.h"
#include "render/present/projectors/display_light.h"
#include "render/present/projectors/projector_drawing.h"
#include "render/present/text_panel.h"
#include "tests/render/present/projectors/projector_light.h"
#include "tests/support/gl_driver.h"

// Hook of LeakSanitizer: disables its reports if a test loaded an OpenGL driver (gl_driver.h).
// NOLINTNEXTLINE: LeakSanitizer prescribes the name
extern "C" int __lsan_is_turned_off() { return ergodome::test::driver_was_loaded ? 1 : 0; }

namespace ergodome {
namespace {

//! A headless OpenGL context and a framebuffer to draw into.
class Present : public testing::Test {
 protected:
  void SetUp() override {
    try {
      test::driver_was_loaded = true;
      context_ = std::make_unique<HeadlessContext>();
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
  }

  static void make_framebuffer(int width, int height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, width, height);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  }

  static Picture picture_of(int width, int height, float light) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgba.assign(4 * static_cast<std::size_t>(width * height), light);
    return picture;
  }

  static Picture corners(int width, int height) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgba.assign(4 * static_cast<std::size_t>(width * height), 0.05F);
    const auto set = [&](int x, int y, int channel) {
      picture.rgba[4 * static_cast<std::size_t>(y * width + x) + static_cast<std::size_t>(channel)] = 0.7F;
    };
    set(0, 0, 0);           // top left red
    set(width - 1, 0, 1);   // top right green
    set(0, height - 1, 2);  // bottom left blue
    return picture;
  }

  std::unique_ptr<HeadlessContext> context_;
};

TEST_F(Present, PictureOfTheWindowsSizeIsTheToneMappedPicture) {
  make_framebuffer(40, 20);
  Presenter presenter;
  const Picture picture = corners(40, 20);
  presenter.upload(picture);
  presenter.draw(40, 20);
  const auto shown = read_framebuffer(40, 20);
  const auto expected = tone_mapped(picture);
  ASSERT_EQ(shown.size(), expected.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    ASSERT_NEAR(shown[i], expected[i], 1) << i;
  }
}

TEST_F(Present, WindowsShowEveryToneAsFilesDo) {
  make_framebuffer(40, 20);
  Presenter presenter;
  for (const ToneCurve curve : {ToneCurve::shoulder, ToneCurve::reinhard, ToneCurve::filmic, ToneCurve::gamma}) {
    Picture picture = corners(40, 20);
    picture.rgba[0] = 30.0F;
    picture.tone = {curve, 1.7F, 3.0F, 1.8F};
    presenter.upload(picture);
    presenter.draw(40, 20);
    const auto shown = read_framebuffer(40, 20);
    const auto expected = tone_mapped(picture);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      ASSERT_NEAR(shown[i], expected[i], 1) << i << " " << static_cast<int>(curve);
    }
  }
}

TEST_F(Present, PicturesAreTheSameIfTheCpuEncodesThem) {
  make_framebuffer(80, 20);
  Picture left = corners(40, 20);
  left.rgba[0] = 30.0F;
  left.tone = {ToneCurve::shoulder, 1.7F, 3.0F, 1.8F};
  Picture right = left;
  std::ranges::reverse(right.rgba);
  Presenter one;
  Presenter other;
  other.encode_before_upload();
  for (Presenter* const presenter : {&one, &other}) {
    presenter->upload_eyes(left, right, false);
  }
  for (const float light : {1.0F, 0.3F}) {
    one.set_light(light);
    other.set_light(light);
    one.draw(80, 20);
    const auto expected = read_framebuffer(80, 20);
    other.draw(80, 20);
    const auto shown = read_framebuffer(80, 20);
    EXPECT_GT(*std::ranges::max_element(shown), 100);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      ASSERT_NEAR(shown[i], expected[i], 1) << i << ", light " << light;
    }
  }
}

TEST_F(Present, PictureOfAnotherShapeIsLetterboxed) {
  make_framebuffer(100, 100);
  Presenter presenter;
  Picture picture = corners(40, 20);
  std::fill(picture.rgba.begin(), picture.rgba.end(), 1.0F);
  presenter.upload(picture);
  presenter.draw(100, 100);
  const auto shown = read_framebuffer(100, 100);
  const auto light = [&](int x, int y) { return shown[3 * static_cast<std::size_t>(100 * y + x)]; };
  EXPECT_EQ(light(50, 10), 0);
  EXPECT_EQ(light(50, 90), 0);
  EXPECT_GT(light(50, 50), 200);
  EXPECT_GT(light(1, 50), 200);
}

TEST_F(Present, BeforeAnyPictureTheWindowIsBlack) {
  make_framebuffer(8, 8);
  Presenter presenter;
  presenter.draw(8, 8);
  for (const auto byte : read_framebuffer(8, 8)) {
    EXPECT_EQ(byte, 0);
  }
}

TEST_F(Present, PicturesMayChangeTheirSize) {
  make_framebuffer(16, 16);
  Presenter presenter;
  for (const int size : {4, 64, 16}) {
    presenter.upload(corners(size, size));
    presenter.draw(16, 16);
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_GT(read_framebuffer(16, 16)[0], 150);
}

TEST_F(Present, EyesFillOnePictureAsJoinedOnesDo) {
  const Picture left = corners(40, 20);
  Picture right = corners(40, 20);
  std::ranges::fill(right.rgba, 0.3F);
  for (const StereoLayout layout : {StereoLayout::side_by_side, StereoLayout::top_bottom}) {
    const Picture joined = joined_eyes(left, right, layout);
    make_framebuffer(joined.width, joined.height);
    Presenter presenter;
    presenter.upload_eyes(left, right, layout == StereoLayout::top_bottom);
    presenter.draw(joined.width, joined.height);
    const auto shown = read_framebuffer(joined.width, joined.height);
    const auto expected = tone_mapped(joined);
    ASSERT_EQ(shown.size(), expected.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      ASSERT_NEAR(shown[i], expected[i], 1) << static_cast<int>(layout) << ", byte " << i;
    }
  }
}

TEST_F(Present, EyesTakeTurnsByTheFramebuffersRows) {
  Picture left = corners(40, 20);
  Picture right = corners(40, 20);
  for (std::size_t i = 0; i < left.rgba.size(); ++i) {
    left.rgba[i] = i % 4 == 0 ? 1.0F : 0.0F;
    right.rgba[i] = i % 4 == 1 ? 1.0F : 0.0F;
  }
  Presenter presenter;
  presenter.upload_eyes(left, right, false);
  struct Framebuffer {
    int width;
    int height;
    int lit_rows;
  };
  // Windows that are finer than the eyes' pictures, coarser, and equal to them; then with bars
  // above and below, whose height is odd, and with bars at the sides.
  for (const Framebuffer& frame :
       {Framebuffer{94, 47, 47}, {30, 15, 15}, {40, 20, 20}, {50, 39, 25}, {50, 40, 25}, {81, 20, 20}}) {
    make_framebuffer(frame.width, frame.height);
    presenter.draw(frame.width, frame.height, PicturePart::halves_by_rows);
    const auto shown = read_framebuffer(frame.width, frame.height);
    int lit_rows = 0;
    for (int y = 0; y < frame.height; ++y) {
      int brightest = 0;
      const int mine = y % 2;
      for (int x = 0; x < frame.width; ++x) {
        const std::uint8_t* const pixel = &shown[3 * static_cast<std::size_t>(y * frame.width + x)];
        brightest = std::max(brightest, static_cast<int>(pixel[mine]));
        ASSERT_EQ(pixel[1 - mine], 0) << x << ", " << y << " of " << frame.width << " x " << frame.height;
      }
      lit_rows += brightest > 200 ? 1 : 0;
    }
    EXPECT_EQ(lit_rows, frame.lit_rows) << frame.width << " x " << frame.height;
  }
}

TEST_F(Present, RowsOfAWindowAsHighAsThePictureAreThoseOfFiles) {
  const Picture left = corners(40, 20);
  Picture right = corners(40, 20);
  std::ranges::reverse(right.rgba);
  make_framebuffer(40, 20);
  Presenter presenter;
  presenter.upload_eyes(left, right, false);
  presenter.draw(40, 20, PicturePart::halves_by_rows);
  const auto shown = read_framebuffer(40, 20);
  const auto expected = tone_mapped(joined_eyes(left, right, StereoLayout::rows));
  ASSERT_EQ(shown.size(), expected.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    ASSERT_NEAR(shown[i], expected[i], 1) << i;
  }
}

TEST_F(Present, AnEyesPictureHasNothingOfTheOtherAtItsEdge) {
  Picture left = corners(40, 20);
  Picture right = corners(40, 20);
  std::ranges::fill(left.rgba, 0.0F);
  std::ranges::fill(right.rgba, 1.0F);
  make_framebuffer(200, 100);
  Presenter presenter;
  presenter.upload_eyes(left, right, false);
  presenter.draw(200, 100, PicturePart::left_half);
  for (const auto byte : read_framebuffer(200, 100)) {
    ASSERT_EQ(byte, 0);
  }
  presenter.draw(200, 100, PicturePart::right_half);
  for (const auto byte : read_framebuffer(200, 100)) {
    ASSERT_GT(byte, 200);
  }
}

TEST_F(Present, CaptionsKeepTheirPixelsOverACoarsePicture) {
  // Captions: a white line that is one pixel high, in a window of 200 x 100 pixels. The picture has
  // 4 x 2 gray pixels.
  const int row = 40;
  auto captions = std::make_shared<CaptionLayer>(CaptionLayer{200, 100, row - 1, 3, std::vector<float>(4 * 200 * 3)});
  std::fill_n(captions->rgba.begin() + 4 * 200, 4 * 200, 1.0F);
  make_framebuffer(200, 100);
  Presenter presenter;
  presenter.upload(picture_of(4, 2, 0.05F));
  presenter.draw(200, 100);
  const int plain = read_framebuffer(200, 100)[0];
  presenter.lay_over({captions}, {});
  presenter.draw(200, 100);
  const auto shown = read_framebuffer(200, 100);
  for (int y = 0; y < 100; ++y) {
    EXPECT_NEAR(shown[3 * (200 * static_cast<std::size_t>(y) + 77)], y == row ? 255 : plain, 1) << y;
  }
  presenter.lay_over({}, {});
  presenter.draw(200, 100);
  EXPECT_NEAR(read_framebuffer(200, 100)[3 * (200 * row + 77)], plain, 1);
}

TEST_F(Present, CaptionsLieOverEachEye) {
  // The caption layer covers the left half of each eye's picture.
  auto captions = std::make_shared<CaptionLayer>(CaptionLayer{100, 100, 0, 100, std::vector<float>(4 * 100 * 100)});
  for (std::size_t i = 0; i < 100 * 100; ++i) {
    std::fill_n(captions->rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, i % 100 < 50 ? 1.0F : 0.0F);
  }
  make_framebuffer(200, 100);
  Presenter presenter;
  presenter.upload(picture_of(4, 2, 0.0F));
  presenter.lay_over({captions}, {2, 1});
  presenter.draw(200, 100);
  const auto shown = read_framebuffer(200, 100);
  for (const auto& [x, light] : {std::pair(25, 255), std::pair(75, 0), std::pair(125, 255), std::pair(175, 0)}) {
    EXPECT_EQ(shown[3 * (200 * 50 + static_cast<std::size_t>(x))], light) << x;
  }
  presenter.draw(200, 100, PicturePart::right_half);
  EXPECT_EQ(read_framebuffer(200, 100)[3 * (200 * 50 + 75)], 255);
}

TEST_F(Present, CaptionsOnProjectorsKeepTheirPixelsOverACoarseMaster) {
  // Captions: a white line that is one pixel high, on a raster of 200 x 200 pixels. It covers half
  // of the light below it and is half faded. The domemaster has 4 x 4 pixels.
  constexpr int side = 200;
  constexpr int row = 40;
  auto captions =
      std::make_shared<CaptionLayer>(CaptionLayer{side, side, row - 1, 3, std::vector<float>(4 * side * 3)});
  std::fill_n(captions->rgba.begin() + 4 * side, 4 * side, 0.5F);
  ProjectorPicture raster;
  raster.width_px = side;
  raster.height_px = side;
  raster.warp.columns = 2;
  raster.warp.rows = 2;
  raster.warp.nodes = {{0, 0, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}, {1, 1, 1, 1}};
  raster.black_level_lift = {0.02, 0.02, 0.02};
  for (WarpNode& node : raster.warp.nodes) {
    node.intensity = 0.5F;
  }
  make_framebuffer(side, side);
  Presenter presenter;
  constexpr float dimmed = 0.6F;
  presenter.set_light(dimmed);
  const Picture master = picture_of(4, 4, 0.05F);
  presenter.upload(master);
  DisplayLight light;
  GLint framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  light.update(presenter.shown());
  ProjectorDrawing projector(raster);
  projector.draw(light, side, side);
  const auto plain = read_framebuffer(side, side);
  CaptionTexture texture;
  projector.draw_captions(texture, dimmed, light, side, side);
  EXPECT_EQ(read_framebuffer(side, side), plain) << "no captions yet";
  texture.set({captions, 0.5});
  projector.draw_captions(texture, dimmed, light, side, side);
  const auto shown = read_framebuffer(side, side);
  const float below = std::min(toned(master.tone, 0.05F), 1.0F);
  const ProjectorColour colour = {0.5F, 0.02F, 1.0F, 2.2F};
  const auto value = [&](float seen) { return 255.0F * projector_value(colour, dimmed * seen); };
  for (int y = 0; y < side; ++y) {
    const auto at = 3 * (side * static_cast<std::size_t>(y) + 77);
    EXPECT_NEAR(shown[at], y == row ? value(0.75F * below + 0.25F) : value(below), 1.0) << y;
    if (y != row) {
      EXPECT_EQ(shown[at], plain[at]) << y;
    }
  }
}

TEST_F(Present, TextHasARimThatSetsItOffFromWhite) {
  make_framebuffer(640, 480);
  TextPanel panel;
  panel.set("HHHH", 36, TextFace::proportional, 0, PanelGround::none);
  for (const float ground : {0.0F, 1.0F}) {
    glClearColor(ground, ground, ground, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    panel.draw(640, 480, PanelPosition::top_left);
    const auto shown = read_framebuffer(640, 480);
    int darkest = 255;
    for (std::size_t x = 0; x < 100; ++x) {
      darkest = std::min<int>(darkest, shown[3 * (640 * 30 + x)]);
    }
    EXPECT_LT(darkest, 60);
    EXPECT_NEAR(shown[3 * (640 * 300 + 320)], static_cast<int>(255.0F * ground), 1) << "the picture stays elsewhere";
  }
}

TEST_F(Present, TextLiesInItsCornerAlone) {
  make_framebuffer(640, 480);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  TextPanel panel;
  panel.set("12.3 ms\ndubois", 16);
  panel.draw(640, 480, PanelPosition::top_left);
  const auto shown = read_framebuffer(640, 480);
  long inside = 0;
  long outside = 0;
  for (std::size_t y = 0; y < 480; ++y) {
    for (std::size_t x = 0; x < 640; ++x) {
      (x < 160 && y < 80 ? inside : outside) += shown[3 * (640 * y + x)];
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_EQ(outside, 0);
}

TEST_F(Present, EmptyTextLeavesThePictureAlone) {
  make_framebuffer(64, 64);
  glClearColor(0.5F, 0.5F, 0.5F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  TextPanel panel;
  panel.set("a", 16);
  panel.set("", 16);
  panel.draw(64, 64, PanelPosition::top_left);
  for (const auto byte : read_framebuffer(64, 64)) {
    ASSERT_NEAR(byte, 128, 1);
  }
}

}  // namespace
}  // namespace ergodome
