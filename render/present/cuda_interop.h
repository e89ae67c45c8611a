#pragma once

#include <cstddef>
#include <cstdint>
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

//! A buffer of OpenGL's that CUDA writes into: what projectors are sent goes from the kernels to a texture without leaving the device.
class CudaBufferLink {
 public:
  //! Throws Error as CudaTextureLink does.
  explicit CudaBufferLink(unsigned buffer);
  ~CudaBufferLink();
  CudaBufferLink(const CudaBufferLink&) = delete;
  CudaBufferLink& operator=(const CudaBufferLink&) = delete;

  //! Fills the beginning of the buffer from device memory.
  void copy_from_device(const std::uint8_t* from, std::size_t bytes);

 private:
  [[maybe_unused]] void* resource_ = nullptr;
};

}  // namespace ergodome
