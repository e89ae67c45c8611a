#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace ergodome {

//! An OpenGL texture that CUDA writes to, so that pictures reach the screen without leaving the
//! GPU.
class CudaTextureLink {
 public:
  //! `texture` must be RGBA32F. Throws Error if CUDA cannot access the context's GPU or is not
  //! available.
  explicit CudaTextureLink(unsigned texture);
  ~CudaTextureLink();
  CudaTextureLink(const CudaTextureLink&) = delete;
  CudaTextureLink& operator=(const CudaTextureLink&) = delete;

  //! Pixels of a picture in GPU memory, four floats each, and their position in the texture.
  struct Part {
    const float* rgba;
    int width;
    int height;
    int left;
    int top;
  };

  //! Copies pictures into parts of the texture. Throws Error if CUDA fails.
  void copy_from_device(std::span<const Part> parts);

 private:
  [[maybe_unused]] void* resource_ = nullptr;
};

//! An OpenGL buffer that CUDA writes to, so that projector images reach a texture without leaving
//! the GPU.
class CudaBufferLink {
 public:
  //! Throws Error if CUDA cannot access the context's GPU or is not available.
  explicit CudaBufferLink(unsigned buffer);
  ~CudaBufferLink();
  CudaBufferLink(const CudaBufferLink&) = delete;
  CudaBufferLink& operator=(const CudaBufferLink&) = delete;

  //! Copies `bytes` bytes from GPU memory to the beginning of the buffer, or as many as it holds.
  //! Throws Error if CUDA fails.
  void copy_from_device(const std::uint8_t* from, std::size_t bytes);

 private:
  [[maybe_unused]] void* resource_ = nullptr;
};

}  // namespace ergodome
