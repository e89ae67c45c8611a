#include "render/present/offscreen_frame.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "kernels/core/error.h"
#include "render/present/presenter.h"

namespace ergodome {

OffscreenFrame::OffscreenFrame(int width, int height) : width_(width), height_(height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest) {
    throw Error("OpenGL", fmt::format("the graphics driver cannot draw a picture of {} x {} pixels", width, height),
                fmt::format("use at most {} pixels a side", largest));
  }
  glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
  glTextureStorage2D(texture_, 1, GL_RGBA8, width, height);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
    throw Error(
        "OpenGL",
        fmt::format("the graphics driver cannot allocate memory for a picture of {} x {} pixels", width, height),
        "choose a smaller resolution");
  }
}

OffscreenFrame::~OffscreenFrame() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void OffscreenFrame::bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

std::vector<std::uint8_t> OffscreenFrame::read_back() const {
  bind();
  return Presenter::read_back(width_, height_);
}

}  // namespace ergodome
