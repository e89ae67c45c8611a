#pragma once

#include <memory>

#include "render/passes/overlay/caption_layer.h"

namespace ergodome {

//! Captions as a texture: light of a display times coverage. Contexts that share its context's objects may use it, too.
class CaptionTexture {
 public:
  CaptionTexture() = default;
  ~CaptionTexture();
  CaptionTexture(const CaptionTexture&) = delete;
  CaptionTexture& operator=(const CaptionTexture&) = delete;

  //! Takes over captions, or none if there is no layer. Uploads a layer only if it is not the last one. Needs its own context current.
  void set(const LaidCaptions& captions);

  //! Binds the texture to a unit of the current context. Returns false if there are no captions.
  bool use(unsigned unit) const;

  [[nodiscard]] bool empty() const { return texture_ == 0; }
  //! Rows of the picture above the captions, as a part of its height.
  [[nodiscard]] float first_row_part() const;
  //! Rows of the captions, as a part of the picture's height.
  [[nodiscard]] float row_part() const;
  [[nodiscard]] float opacity() const { return opacity_; }

 private:
  void remove();

  std::shared_ptr<const CaptionLayer> layer_;
  float opacity_ = 1.0F;
  unsigned texture_ = 0;
  void* uploaded_ = nullptr;  //!< a GLsync: passed when the texture is complete
};

}  // namespace ergodome
