#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "kernels/core/error.h"
#include "kernels/launch/launch.h"
#include "render/backend/buffer.h"
#include "render/opengl/headless_context.h"
#include "render/output/tone_map.h"
#include "render/present/presenter.h"
#include "render/present/projectors/raster_texture.h"
#include "tests/support/gl_driver.h"

// Hook of LeakSanitizer: disables its reports if a test loaded an OpenGL driver (gl_driver.h).
// NOLINTNEXTLINE: LeakSanitizer prescribes the name
extern "C" int __lsan_is_turned_off() { return ergodome::test::driver_was_loaded ? 1 : 0; }

namespace ergodome {
namespace {

//! Returns a picture whose pixels all differ.
Picture gradient(int width, int height) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  for (int i = 0; i < width * height; ++i) {
    const auto x = static_cast<float>(i % width) / static_cast<float>(width);
    const int row = i / width;
    const auto y = static_cast<float>(row) / static_cast<float>(height);
    for (const float value : {x, y, 0.5F * (x + y), 1.0F}) {
      picture.rgba.push_back(value);
    }
  }
  return picture;
}

//! Tests of pictures that CUDA and OpenGL share on the same GPU.
class DevicePictures : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* const reason = cuda_unavailable_reason()) {
      GTEST_SKIP() << reason;
    }
    try {
      test::driver_was_loaded = true;
      context_ = std::make_unique<HeadlessContext>();
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
    const std::string_view vendor(reinterpret_cast<const char*>(glGetString(GL_VENDOR)));
    if (vendor.find("NVIDIA") == std::string_view::npos) {
      GTEST_SKIP() << "OpenGL is by " << vendor;
    }
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, size, size);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  }

  static void expect_shown(Presenter& presenter, const Picture& picture) {
    const Buffer<float> there(Backend::cuda, std::vector<float>(picture.rgba.begin(), picture.rgba.end()), "test");
    presenter.upload_from_device(
        {.rgba = there.data(), .width_px = picture.width, .height_px = picture.height, .tone = picture.tone});
    presenter.draw(picture.width, picture.height);
    const auto shown = read_framebuffer(picture.width, picture.height);
    const auto expected = tone_mapped(picture);
    ASSERT_EQ(shown.size(), expected.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      ASSERT_NEAR(shown[i], expected[i], 1) << i;
    }
  }

  static constexpr int size = 64;
  std::unique_ptr<HeadlessContext> context_;
};

TEST_F(DevicePictures, AreShownWithoutAWayThroughTheHost) {
  Presenter presenter;
  expect_shown(presenter, gradient(size, size));
}

TEST_F(DevicePictures, AreShownWhenTheirSizeChanges) {
  Presenter presenter;
  expect_shown(presenter, gradient(size, size));
  expect_shown(presenter, gradient(size / 2, size / 2));
  presenter.upload(gradient(size, size));
  expect_shown(presenter, gradient(size, size));
}

TEST_F(DevicePictures, OfTwoEyesFillOneTogether) {
  const Picture left = gradient(size / 2, size / 2);
  Picture right = gradient(size / 2, size / 2);
  std::reverse(right.rgba.begin(), right.rgba.end());
  const auto copied = [](const Picture& picture) {
    return Buffer<float>(Backend::cuda, std::vector<float>(picture.rgba.begin(), picture.rgba.end()), "test");
  };
  const Buffer<float> first = copied(left);
  const Buffer<float> second = copied(right);
  for (const bool above : {false, true}) {
    const int width = above ? size / 2 : size;
    const int height = above ? size : size / 2;
    Presenter presenter;
    presenter.upload_eyes(left, right, above);
    presenter.draw(width, height);
    const auto expected = read_framebuffer(width, height);
    presenter.upload_from_device({first.data(), second.data(), above, size / 2, size / 2, false, left.tone});
    presenter.draw(width, height);
    EXPECT_EQ(read_framebuffer(width, height), expected);
  }
}

TEST_F(DevicePictures, OfProjectorsAreShownByteByByte) {
  RasterTexture texture(size, size);
  std::vector<std::uint8_t> bytes(std::size_t{3} * size * size);
  for (const std::size_t step : {5, 7}) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<std::uint8_t>(step * i);
    }
    const Buffer<std::uint8_t> there(Backend::cuda, bytes, "test");
    texture.upload_from_device(there.data());
    texture.draw();
    EXPECT_EQ(read_framebuffer(size, size), bytes);
  }
}

}  // namespace
}  // namespace ergodome
