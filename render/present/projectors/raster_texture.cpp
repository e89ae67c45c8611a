#include "render/present/projectors/raster_texture.h"

#include <epoxy/gl.h>

namespace ergodome {

RasterTexture::RasterTexture(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
  glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
  glTextureStorage2D(texture_, 1, GL_RGBA8, width_px, height_px);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
}

RasterTexture::~RasterTexture() {
  link_.reset();
  glDeleteBuffers(1, &pixels_);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void RasterTexture::upload(const std::uint8_t* rgb) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture_, 0, 0, 0, width_px_, height_px_, GL_RGB, GL_UNSIGNED_BYTE, rgb);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void RasterTexture::upload_from_device(const std::uint8_t* rgb) {
  const std::size_t bytes = 3 * static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
  if (!link_) {
    glCreateBuffers(1, &pixels_);
    glNamedBufferStorage(pixels_, static_cast<GLsizeiptr>(bytes), nullptr, 0);
    link_ = std::make_unique<CudaBufferLink>(pixels_);
  }
  link_->copy_from_device(rgb, bytes);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, pixels_);
  upload(nullptr);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void RasterTexture::draw() const {
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  // The texture's first row is the top, a framebuffer's the bottom.
  glBlitNamedFramebuffer(framebuffer_, static_cast<GLuint>(bound), 0, 0, width_px_, height_px_, 0, height_px_,
                         width_px_, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace ergodome
