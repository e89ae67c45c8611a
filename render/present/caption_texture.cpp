#include "render/present/caption_texture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>

namespace ergodome {

CaptionTexture::~CaptionTexture() { remove(); }

void CaptionTexture::remove() {
  if (texture_ != 0) {
    glDeleteSync(static_cast<GLsync>(uploaded_));
    glDeleteTextures(1, &texture_);
  }
  uploaded_ = nullptr;
  texture_ = 0;
}

void CaptionTexture::set(const LaidCaptions& captions) {
  opacity_ = static_cast<float>(captions.opacity);
  if (captions.layer == layer_) {
    return;
  }
  remove();
  layer_ = captions.layer;
  if (!layer_) {
    return;
  }
  glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
  const auto longest = static_cast<unsigned>(std::max(layer_->width, layer_->row_count));
  glTextureStorage2D(texture_, static_cast<GLsizei>(std::bit_width(longest)), GL_RGBA16F, layer_->width,
                     layer_->row_count);
  glTextureSubImage2D(texture_, 0, 0, 0, layer_->width, layer_->row_count, GL_RGBA, GL_FLOAT, layer_->rgba.data());
  glGenerateTextureMipmap(texture_);
  glTextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // Makes the texture transparent outside the rows of the captions.
  glTextureParameteri(texture_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  uploaded_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  // Submits the fence to the GPU, because other contexts wait for it.
  glFlush();
}

bool CaptionTexture::use(unsigned unit) const {
  if (texture_ == 0) {
    return false;
  }
  glWaitSync(static_cast<GLsync>(uploaded_), 0, GL_TIMEOUT_IGNORED);
  glBindTextureUnit(unit, texture_);
  return true;
}

float CaptionTexture::first_row_part() const {
  return layer_ ? static_cast<float>(layer_->first_row) / static_cast<float>(layer_->height) : 0.0F;
}

float CaptionTexture::row_part() const {
  return layer_ ? static_cast<float>(layer_->row_count) / static_cast<float>(layer_->height) : 0.0F;
}

}  // namespace ergodome
