#pragma once

#include <memory>

#include "render/passes/overlay/caption_layer.h"

namespace ergodome {

//! Captions as an OpenGL texture: display light times coverage. All contexts that share objects
//! with the context that created it can use it.
class CaptionTexture {
 public:
  CaptionTexture() = default;
  ~CaptionTexture();
  CaptionTexture(const CaptionTexture&) = delete;
  CaptionTexture& operator=(const CaptionTexture&) = delete;

  //! Replaces the captions; without a layer it removes them. Uploads the layer only if it has
  //! changed. The texture's context must be current.
  void set(const LaidCaptions& captions);

  //! Binds the texture to a unit of the current context. Returns false if there are no captions.
  bool use(unsigned unit) const;

  [[nodiscard]] bool empty() const { return texture_ == 0; }
  //! Returns the position of the first row with captions, as a fraction of the picture's height
  //! from the top.
  [[nodiscard]] float first_row_part() const;
  //! Returns the height of the rows with captions, as a fraction of the picture's height.
  [[nodiscard]] float row_part() const;
  [[nodiscard]] float opacity() const { return opacity_; }

 private:
  void remove();

  std::shared_ptr<const CaptionLayer> layer_;
  float opacity_ = 1.0F;
  unsigned texture_ = 0;
  void* uploaded_ = nullptr;  //!< a GLsync that is signaled when the texture is completely uploaded
};

}  // namespace ergodome
