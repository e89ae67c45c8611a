#pragma once

#include <span>

namespace ergodome {

//! A texture that CUDA writes into: pictures go from the kernels to the screen without leaving the device.
class CudaTextureLink {
 public:
  //! `texture` is RGBA32F. Throws Error where CUDA cannot reach the context's device, or without CUDA.
  explicit CudaTextureLink(unsigned texture);
  ~CudaTextureLink();
  CudaTextureLink(const CudaTextureLink&) = delete;
  CudaTextureLink& operator=(const CudaTextureLink&) = delete;

  //! Pixels of a picture in device memory, four floats each, and where in the texture they go.
  struct Part {
    const float* rgba;
    int width;
    int height;
    int left;
    int top;
  };

  //! Copies parts of the texture.
  void copy_from_device(std::span<const Part> parts);

 private:
  [[maybe_unused]] void* resource_ = nullptr;
};

}  // namespace ergodome
