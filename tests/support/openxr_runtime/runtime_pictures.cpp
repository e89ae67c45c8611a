// Reads submitted images back and writes them to files.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/support/openxr_runtime/runtime_gl.h"

namespace ergodome::openxr_test {

namespace {

//! Sets OpenGL's state for reading pixels, and restores the program's state at the end.
class PixelReading {
 public:
  PixelReading() {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      glGetIntegerv(parameters[i], &values_[i]);
      glPixelStorei(parameters[i], parameters[i] == GL_PACK_ALIGNMENT ? 1 : 0);
    }
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &framebuffer_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glGenFramebuffers(1, &own_framebuffer_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, own_framebuffer_);
  }
  ~PixelReading() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
    glDeleteFramebuffers(1, &own_framebuffer_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(buffer_));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      glPixelStorei(parameters[i], values_[i]);
    }
  }
  PixelReading(const PixelReading&) = delete;
  PixelReading& operator=(const PixelReading&) = delete;

 private:
  static constexpr std::array<GLenum, 4> parameters = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS,
                                                       GL_PACK_SKIP_PIXELS};
  std::array<GLint, 4> values_{};
  GLint buffer_ = 0;
  GLint framebuffer_ = 0;
  GLuint own_framebuffer_ = 0;
};

std::uint8_t srgb_byte(float linear) {
  const float light = std::clamp(linear, 0.0F, 1.0F);
  const float encoded = light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

//! Reads a rectangle in sRGB, the bottom row first. Linear formats are encoded.
std::vector<std::uint8_t> read_srgb(std::int64_t format, const XrRect2Di& rect) {
  const std::size_t count = std::size_t{3} * static_cast<std::size_t>(rect.extent.width * rect.extent.height);
  std::vector<std::uint8_t> bytes(count);
  const auto read = [&](GLenum type, void* pixels) {
    glReadPixels(rect.offset.x, rect.offset.y, rect.extent.width, rect.extent.height, GL_RGB, type, pixels);
  };
  if (format == GL_SRGB8_ALPHA8) {
    read(GL_UNSIGNED_BYTE, bytes.data());
    return bytes;
  }
  std::vector<float> linear(count);
  read(GL_FLOAT, linear.data());
  std::transform(linear.begin(), linear.end(), bytes.begin(), srgb_byte);
  return bytes;
}

}  // namespace

bool write_picture(const std::string& file_name, const Swapchain& swapchain, const XrSwapchainSubImage& part) {
  const PixelReading reading;
  const GLuint texture = swapchain.textures.at(*swapchain.released);
  if (swapchain.info.arraySize > 1) {
    glFramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0,
                              static_cast<GLint>(part.imageArrayIndex));
  } else {
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  }
  const XrRect2Di& rect = part.imageRect;
  const std::vector<std::uint8_t> pixels = read_srgb(swapchain.info.format, rect);
  std::filesystem::create_directories(std::filesystem::path(file_name).parent_path());
  std::ofstream file(file_name, std::ios::binary);
  file << "P6\n" << rect.extent.width << ' ' << rect.extent.height << "\n255\n";
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{3} * rect.extent.width;
  for (std::ptrdiff_t row = rect.extent.height - 1; row >= 0; --row) {
    file.write(reinterpret_cast<const char*>(pixels.data()) + row * row_bytes, row_bytes);
  }
  return file.good();
}

}  // namespace ergodome::openxr_test
