#include "render/present/cuda_interop.h"

#include <cuda_gl_interop.h>

#include <string>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

void check(cudaError_t code, const char* doing) {
  if (code != cudaSuccess) {
    // Clears the error; otherwise the next launch would report it.
    cudaGetLastError();
    throw Error("CUDA and OpenGL", std::string(doing) + " failed: " + cudaGetErrorString(code),
                "run with --backend cpu");
  }
}

}  // namespace

CudaTextureLink::CudaTextureLink(unsigned texture) {
  cudaGraphicsResource_t resource = nullptr;
  check(cudaGraphicsGLRegisterImage(&resource, texture, GL_TEXTURE_2D, cudaGraphicsRegisterFlagsWriteDiscard),
        "giving CUDA access to the picture");
  resource_ = resource;
}

CudaTextureLink::~CudaTextureLink() { cudaGraphicsUnregisterResource(static_cast<cudaGraphicsResource_t>(resource_)); }

void CudaTextureLink::copy_from_device(std::span<const Part> parts) {
  auto* resource = static_cast<cudaGraphicsResource_t>(resource_);
  check(cudaGraphicsMapResources(1, &resource), "preparing the picture for CUDA");
  cudaArray_t array = nullptr;
  cudaError_t copied = cudaGraphicsSubResourceGetMappedArray(&array, resource, 0, 0);
  constexpr std::size_t pixel = 4 * sizeof(float);
  for (const Part& part : parts) {
    const std::size_t row = pixel * static_cast<std::size_t>(part.width);
    if (copied == cudaSuccess) {
      copied =
          cudaMemcpy2DToArray(array, pixel * static_cast<std::size_t>(part.left), static_cast<std::size_t>(part.top),
                              part.rgba, row, row, static_cast<std::size_t>(part.height), cudaMemcpyDeviceToDevice);
    }
  }
  check(cudaGraphicsUnmapResources(1, &resource), "returning the picture to OpenGL");
  check(copied, "copying the picture to OpenGL");
}

CudaBufferLink::CudaBufferLink(unsigned buffer) {
  cudaGraphicsResource_t resource = nullptr;
  check(cudaGraphicsGLRegisterBuffer(&resource, buffer, cudaGraphicsRegisterFlagsWriteDiscard),
        "giving CUDA access to a projector's picture");
  resource_ = resource;
}

CudaBufferLink::~CudaBufferLink() { cudaGraphicsUnregisterResource(static_cast<cudaGraphicsResource_t>(resource_)); }

void CudaBufferLink::copy_from_device(const std::uint8_t* from, std::size_t bytes) {
  auto* resource = static_cast<cudaGraphicsResource_t>(resource_);
  check(cudaGraphicsMapResources(1, &resource), "preparing a projector's picture for CUDA");
  void* to = nullptr;
  std::size_t room = 0;
  cudaError_t copied = cudaGraphicsResourceGetMappedPointer(&to, &room, resource);
  if (copied == cudaSuccess) {
    copied = cudaMemcpyAsync(to, from, bytes < room ? bytes : room, cudaMemcpyDeviceToDevice);
  }
  check(cudaGraphicsUnmapResources(1, &resource), "returning a projector's picture to OpenGL");
  check(copied, "copying a projector's picture to OpenGL");
}

}  // namespace ergodome
