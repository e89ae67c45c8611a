#include "kernels/core/error.h"
#include "render/present/cuda_interop.h"

namespace ergodome {

CudaTextureLink::CudaTextureLink(unsigned) {
  throw Error("CUDA", "this program was built without CUDA", "run with --backend cpu");
}

CudaTextureLink::~CudaTextureLink() = default;

void CudaTextureLink::copy_from_device(std::span<const Part>) {}

}  // namespace ergodome
