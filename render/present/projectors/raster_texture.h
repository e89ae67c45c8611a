#pragma once

#include <cstdint>
#include <memory>

#include "render/present/cuda_interop.h"

namespace ergodome {

//! Bytes as a display is sent them, in the OpenGL context that is current when it is made and used.
class RasterTexture {
 public:
  RasterTexture(int width_px, int height_px);
  ~RasterTexture();
  RasterTexture(const RasterTexture&) = delete;
  RasterTexture& operator=(const RasterTexture&) = delete;

  //! Takes over RGB bytes of its size, the top row first.
  void upload(const std::uint8_t* rgb);

  //! The same from CUDA device memory, without a way through the host. Throws Error where CUDA cannot reach the context's device.
  void upload_from_device(const std::uint8_t* rgb);

  //! Copies them to the bound framebuffer, which is as large.
  void draw() const;

 private:
  int width_px_;
  int height_px_;
  unsigned texture_ = 0;
  unsigned framebuffer_ = 0;
  unsigned pixels_ = 0;  //!< where CUDA puts the bytes: it cannot reach textures of three bytes
  std::unique_ptr<CudaBufferLink> link_;
};

}  // namespace ergodome
