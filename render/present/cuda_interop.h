#pragma once

namespace ergodome {

//! A texture that CUDA writes into: pictures go from the kernels to the screen without leaving the device.
class CudaTextureLink {
 public:
  //! `texture` is RGBA32F. Throws Error where CUDA cannot reach the context's device, or without CUDA.
  CudaTextureLink(unsigned texture, int width, int height);
  ~CudaTextureLink();
  CudaTextureLink(const CudaTextureLink&) = delete;
  CudaTextureLink& operator=(const CudaTextureLink&) = delete;

  //! Copies width * height pixels, four floats each, from device memory.
  void copy_from_device(const float* rgba);

 private:
  [[maybe_unused]] void* resource_ = nullptr;
  [[maybe_unused]] int width_ = 0;
  [[maybe_unused]] int height_ = 0;
};

}  // namespace ergodome
