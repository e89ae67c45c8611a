#include "render/present/cuda_interop.h"

#include <cuda_gl_interop.h>

#include <string>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

void check(cudaError_t code, const char* doing) {
  if (code != cudaSuccess) {
    throw Error("CUDA and OpenGL", std::string(doing) + " failed: " + cudaGetErrorString(code),
                "run with --backend cpu");
  }
}

}  // namespace

CudaTextureLink::CudaTextureLink(unsigned texture, int width, int height) : width_(width), height_(height) {
  cudaGraphicsResource_t resource = nullptr;
  check(cudaGraphicsGLRegisterImage(&resource, texture, GL_TEXTURE_2D, cudaGraphicsRegisterFlagsWriteDiscard),
        "sharing the picture");
  resource_ = resource;
}

CudaTextureLink::~CudaTextureLink() { cudaGraphicsUnregisterResource(static_cast<cudaGraphicsResource_t>(resource_)); }

void CudaTextureLink::copy_from_device(const float* rgba) {
  auto* resource = static_cast<cudaGraphicsResource_t>(resource_);
  check(cudaGraphicsMapResources(1, &resource), "mapping the picture");
  cudaArray_t array = nullptr;
  const cudaError_t found = cudaGraphicsSubResourceGetMappedArray(&array, resource, 0, 0);
  const std::size_t row = 4 * sizeof(float) * static_cast<std::size_t>(width_);
  const cudaError_t copied = found == cudaSuccess
                                 ? cudaMemcpy2DToArray(array, 0, 0, rgba, row, row, static_cast<std::size_t>(height_),
                                                       cudaMemcpyDeviceToDevice)
                                 : found;
  check(cudaGraphicsUnmapResources(1, &resource), "giving back the picture");
  check(copied, "copying the picture");
}

}  // namespace ergodome
