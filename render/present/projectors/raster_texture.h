#pragma once

#include <cstdint>
#include <memory>

#include "render/present/cuda_interop.h"

namespace ergodome {

//! An image of RGB bytes, encoded for the display, as an OpenGL texture. The same context must be
//! current when it is created and used.
class RasterTexture {
 public:
  RasterTexture(int width_px, int height_px);
  ~RasterTexture();
  RasterTexture(const RasterTexture&) = delete;
  RasterTexture& operator=(const RasterTexture&) = delete;

  //! Uploads an image: RGB bytes, top row first, of the texture's size.
  void upload(const std::uint8_t* rgb);

  //! Uploads from CUDA memory without a copy through the host. Throws Error if CUDA cannot access
  //! the context's GPU.
  void upload_from_device(const std::uint8_t* rgb);

  //! Copies the image to the bound framebuffer of the same size.
  void draw() const;

 private:
  int width_px_;
  int height_px_;
  unsigned texture_ = 0;
  unsigned framebuffer_ = 0;
  //! Buffer that CUDA writes to, because CUDA cannot access textures with three bytes per pixel.
  unsigned pixels_ = 0;
  std::unique_ptr<CudaBufferLink> link_;
};

}  // namespace ergodome
